; Draws from a bottle and gives to an outlet, three times; output 1 says that the pump is at work.
HSPD=8000
LSPD=400
ACC=200
EO=3
DO1=1
HOMEY-
WAITY
HLHOMEX-
WAITX
V1=0
WHILE V1<3
  Y500
  WAITY
  IF DI1=1
    X40000
    WAITX
    Y1500
    WAITY
    IF DI2=1
      X0
      WAITX
      V1=V1+1
    ENDIF
  ENDIF
ENDWHILE
DO1=0
END
