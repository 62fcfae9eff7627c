; Moves between 0 and 1000 for ever.
PRG 1
  HSPD=20000
  LSPD=1000
  ACC=300
  EO=1
  WHILE 1=1
    X0
    WAITX
    X1000
    WAITX
  ENDWHILE
END
