#include "materials/porous_film.h"

#include "materials/effective_medium.h"

namespace drude {

OpticalConstants porous_constants(const OpticalConstants& dense, double porosity,
                                  const std::vector<double>& wavelengths_nm) {
    OpticalConstants constants;
    constants.kind = "calculated";
    for (const double nm : wavelengths_nm) {
        const Index solid = dense.at(nm);
        const auto mixed =
            bruggeman(ComplexIndex<double>{solid.n, solid.k}, ComplexIndex<double>{1, 0}, porosity);
        constants.wavelength_nm.push_back(nm);
        constants.n.push_back(mixed.n);
        constants.k.push_back(mixed.k);
    }
    return constants;
}

}  // namespace drude
