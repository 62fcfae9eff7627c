; Moves on by 1000 at each rising edge of input 1.
HSPD=20000
LSPD=1000
ACC=300
EO=1
V1=0                        ; the next target
WHILE 1=1
  IF DI1=1
    GOSUB 1
  ENDIF
ENDWHILE
END

SUB 1
  XV1
  WAITX
  V1=V1+1000
  WHILE DI1=1               ; one step an edge
  ENDWHILE
ENDSUB
