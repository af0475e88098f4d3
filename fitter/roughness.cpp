#include "fitter/roughness.h"

#include "materials/effective_medium.h"

namespace drude {

FilmLayer roughness_layer(const OpticalConstants& below, double thickness_nm) {
    FilmLayer layer;
    layer.thickness_nm = thickness_nm;
    OpticalConstants& constants = layer.constants;
    constants.name = "roughness of " + below.name;
    constants.material = below.material;
    constants.kind = "calculated";
    constants.citation = "Bruggeman's mixture of " + below.name + " and as much void";
    constants.wavelength_nm = below.wavelength_nm;
    for (size_t i = 0; i < below.n.size(); ++i) {
        const ComplexIndex<double> half = bruggeman(ComplexIndex<double>{below.n[i], below.k[i]},
                                                    ComplexIndex<double>{1, 0}, roughness_void);
        constants.n.push_back(half.n);
        constants.k.push_back(half.k);
    }
    return layer;
}

}  // namespace drude
