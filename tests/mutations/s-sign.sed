# The sign of S (and so of Delta) in a reflection
# file: src/render/throughput.h
# lines: 1
s/C = f \* r\.C, S = f \* r\.S;/C = f * r.C, S = f * -r.S;/
