; A contour of seven lines, each with its speed, from the buffer.
PRG 1
  BUFON
  HSPD=100
  X1000Y100Z100
  HSPD=200
  X2000Y100Z100
  HSPD=300
  X3000Y100Z100
  HSPD=400
  X4000Y100Z100
  HSPD=500
  X5000Y100Z100
  HSPD=400
  X3000Y100Z100
  HSPD=300
  X0Y100Z100
  ISTART
  DELAY=100                 ; until the first line has begun
  WAITX
  BUFOFF
END
