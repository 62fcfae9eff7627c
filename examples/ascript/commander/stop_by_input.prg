; Program 1 stops program 0 while input 1 is on.
PRG 0
  HSPD=20000
  LSPD=500
  ACC=500
  WHILE 1=1
    X0
    WAITX
    X1000
    WAITX
  ENDWHILE
END

PRG 1
  WHILE 1=1
    IF DI1=1
      ABORTX
      SR0=0
    ELSE
      SR0=1                 ; nothing if it runs already
    ENDIF
  ENDWHILE
END
