# s and p exchanged: Rs for Rp, and Delta's sign with them
# file: src/render/spectral_tables.h
# lines: 1
s/if (films\.empty()) return reflect(substrate, P(cos_theta));/if (films.empty()) { const Reflection<P> r = reflect(substrate, P(cos_theta)); return {r.Rp, r.Rs, r.C, -r.S}; }/
