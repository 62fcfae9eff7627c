; Moves to 1000 and back to 0.
PRG 0
  HSPD=20000                ; pulses a second
  LSPD=1000
  ACC=300                   ; milliseconds
  EO=1                      ; power to motor X
  X1000
  WAITX                     ; until the move is complete
  X0
  WAITX
END
