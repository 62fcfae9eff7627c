; Lines, a circle and an arc of three axes, then the same speeds from the buffer.
PRG 0
  HSPD=20000
  LSPD=500
  ACC=100
  EO=15
  X3000Y-2000Z1000
  WAITX
  CIRXYP2000:-2000
  WAITX
  ARCXYN3000:0:0
  WAITX
  BUFON
  HSPD=4000
  X1000Y0Z0
  HSPD=8000
  X0Y500Z0
  HSPD=6000
  X0Y0Z0
  ISTART
  DELAY=20                  ; until the first line has begun
  WAITX
  BUFOFF
END
