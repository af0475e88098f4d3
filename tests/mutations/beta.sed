# beta up by 5 %
# file: src/render/spectral_tables.h
# lines: 1
s/Microfacets<float>(surface\.lobe, surface\.masking, surface\.beta)/Microfacets<float>(surface.lobe, surface.masking, 1.05 * surface.beta)/
