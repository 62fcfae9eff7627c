; Moves between 0 and 1000 while input 1 is on.
HSPD=20000
LSPD=1000
ACC=300
EO=1
WHILE 1=1
  IF DI1=1
    X0
    WAITX
    X1000
    WAITX
  ENDIF
ENDWHILE
END
