; Program 1 stops all motion for three seconds when the driver has an alarm.
PRG 0
  HSPD=1000
  LSPD=500
  ACC=500
  EO=1
  GOSUB 1
  WHILE 1=1
    X0
    WAITX
    X1000
    WAITX
  ENDWHILE
END

PRG 1
  WHILE 1=1
    V1=MSTX&1024            ; the alarm's bit
    IF V1=1024
      SR0=0
      ABORTX
      DO=0
      DELAY=3000
      ECLEARX
      SR0=1
      DO=1
    ENDIF
  ENDWHILE
END

; Homes.
SUB 1
  HOMEX-6
  WAITX
ENDSUB

; Errors.
SUB 31
  ECLEARX
  X0
  DO2=1
ENDSUB
