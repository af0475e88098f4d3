# No MIS weight for the light sample
# file: src/render/path.h
# lines: 1
s/const float weight = l\.is_delta ? 1 : mis(l\.pdf, e\.pdf);/const float weight = 1;/
