# The frame of a reflection turned the wrong way
# file: src/render/throughput.h
# lines: 1
s/m1 = c \* m\[1\] + s \* m\[2\], m2 = c \* m\[2\] - s \* m\[1\];/m1 = c * m[1] - s * m[2], m2 = c * m[2] + s * m[1];/
