# Fresnel at the angle to the surface instead of the angle to the facet
# file: src/render/path.h
# lines: 1
s/metal\.reflection(std::min(1\.0f, glm::dot(i, m)), phase)/metal.reflection(std::min(1.0f, i.z), phase)/
