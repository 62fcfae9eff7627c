; Moves between 0 and 1000 ten times.
PRG 1
  HSPD=20000
  LSPD=1000
  ACC=300
  EO=1
  V1=0                      ; rounds made
  WHILE V1<10
    X0
    WAITX
    X1000
    WAITX
    V1=V1+1
  ENDWHILE
END
