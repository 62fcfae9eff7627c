; Draws a circle, a line and an arc with a laser on output 2; program 3 shows lights meanwhile.
PRG 1
  GOSUB 1
  GOSUB 7
  WHILE 1=1
    ; The circle.
    X85610Y562530
    WAITX
    GOSUB 2
    CIRXYP487659:562431
    WAITX
    GOSUB 1
    ; The line.
    X100000Y100000
    WAITX
    GOSUB 2
    X909000Y642390
    WAITX
    GOSUB 1
    ; The arc.
    X430589Y20623
    WAITX
    GOSUB 2
    ARCXYN288899:267403:95000
    WAITY
    GOSUB 1
  ENDWHILE
END

PRG 3
  WHILE 1=1
    IO=64                   ; light 7, then 5, 3 and 1 too
    DELAY=700
    IO=80
    DELAY=700
    IO=84
    DELAY=700
    IO=85
    DELAY=700
    V30=0
    WHILE V30<10            ; all of them blink ten times
      IO=85
      DELAY=50
      IO=0
      DELAY=50
      V30=V30+1
    ENDWHILE
  ENDWHILE
END

; Laser off.
SUB 1
  DO2=0
  DELAY=10
ENDSUB

; Laser on.
SUB 2
  DO2=1
  DELAY=10
ENDSUB

; Homes both axes and moves to the start.
SUB 7
  HSPD=15000
  LSPD=500
  ACC=100
  EO=3
  HOMEX-6
  WAITX
  HOMEY-6
  WAITY
  HSPD=35000
  X500000Y500000
  WAITX
ENDSUB

; Errors: all stands still, in the dark.
SUB 31
  SR1=0
  SR3=0
  ABORT
  ECLEARX
  ECLEARY
  IO=0
  DO2=0
ENDSUB
