# The Jacobian 1/(4 o.m) of the half vector left out of the density of a sampled direction
# file: materials/microfacet.h
# lines: 1
s|s\.pdf = D(s\.m) \* g1 / (4 \* o\.z);|s.pdf = D(s.m) * g1 * om / o.z;|
