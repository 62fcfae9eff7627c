; Each input has its position; input 5 homes. Output 1 shows that the motor moves.
HSPD=20000
LSPD=1000
ACC=300
EO=1
WHILE 1=1
  IF DI1=1
    X1000
    WAITX
  ELSEIF DI2=1
    X2000
    WAITX
  ELSEIF DI3=1
    X3000
    WAITX
  ELSEIF DI5=1
    HOMEX-
    WAITX
  ENDIF
  V1=MSTX
  V2=V1&7                   ; accelerates, decelerates, or runs
  IF V2!=0
    DO1=1
  ELSE
    DO1=0
  ENDIF
ENDWHILE
END
