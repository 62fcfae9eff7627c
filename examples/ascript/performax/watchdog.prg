; Program 1 stops all motion for three seconds when the host is silent for five.
PRG 0
  HSPD=1000
  LSPD=500
  ACC=500
  TOC=5000                  ; milliseconds
  EO=1
  WHILE 1=1
    X0
    WAITX
    X1000
    WAITX
  ENDWHILE
END

PRG 1
  WHILE 1=1
    V1=MSTX&2048            ; the time-out's bit
    IF V1=2048
      SR0=0
      ABORTX
      DO=0
      DELAY=3000
      SR0=1
      DO=1
    ENDIF
  ENDWHILE
END
