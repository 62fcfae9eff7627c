; Takes three parts from a tray, 8000 pulses apart, and puts each on the table.
EO=7
HSPD=5000
LSPD=500
ACC=300
HOMEZ+1                     ; the gripper first, so that nothing is in the way
WAITZ
HOMEX-1
WAITX
HOMEY-1
WAITY
HSPD=20000
V1=0
V2=20000
WHILE V1<3
  XV2Y5000                  ; above the part
  WAITX
  WAITY
  GOSUB 1
  DO1=1
  GOSUB 2
  X80000Y50000              ; above the table
  WAITX
  WAITY
  GOSUB 1
  DO1=0
  GOSUB 2
  V2=V2+8000
  V1=V1+1
ENDWHILE
END

; Down until the light barrier sees the gripper.
SUB 1
  Z-12000
  WAITZ
  IF DI1=0
    ABORT
  ENDIF
  DELAY=50
ENDSUB

; Up.
SUB 2
  DELAY=50
  Z0
  WAITZ
ENDSUB
