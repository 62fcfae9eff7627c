; Each input has its position; input 4 homes. Output 1 shows that the motor moves. Errors are cleared, and the
; motor goes back to 0.
PRG 2
  HSPD=15000
  LSPD=500
  ACC=300
  EO=1
  WHILE 1=1
    IF DI1=1
      X2000                 ; ignored while the axis moves
    ELSEIF DI2=1
      X4000
    ELSEIF DI3=1
      X6000
    ELSEIF DI4=1
      HOMEX-0
    ENDIF
    V1=MSTX
    V2=V1&7                 ; accelerates, decelerates, or runs
    IF V2!=0
      DO1=1
    ELSE
      DO1=0
    ENDIF
  ENDWHILE
END

SUB 31
  ECLEARX
  X0
  DO2=1
ENDSUB
