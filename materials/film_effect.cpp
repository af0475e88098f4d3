#include "materials/film_effect.h"

#include <algorithm>
#include <cmath>

#include "materials/film_average.h"
#include "materials/film_stack.h"
#include "materials/spectrum.h"

namespace drude {

double film_effect(const Material& material) {
    if (material.layers.empty()) return 0;
    constexpr int angles = 16, step_nm = 10;
    constexpr double largest_angle = 88 * pi / 180;
    double largest = 0;
    for (int nm = spectrum_first_nm; nm <= spectrum_last_nm; nm += step_nm) {
        for (int i = 0; i < angles; ++i) {
            const double cosine = std::cos(largest_angle * i / (angles - 1));
            const int harmonics = film_harmonics(material, nm, cosine);
            Reflection<double> with{0, 0, 0, 0}, bare{0, 0, 0, 0};
            for (const FilmSample& sample : film_samples(material, nm, 1.0, harmonics)) {
                std::vector<ThinFilm<double>> films;
                for (size_t j = 0; j < sample.layers.size(); ++j) {
                    films.push_back(
                        {{sample.layers[j].n, sample.layers[j].k}, sample.thickness_nm[j]});
                }
                const ComplexIndex<double> substrate{sample.substrate.n, sample.substrate.k};
                add_weighted(reflect(films.data(), static_cast<int>(films.size()), substrate,
                                     cosine, sample.wavelength_nm),
                             sample.weight, &with);
                // Averaged alike, so that the films alone make the difference.
                add_weighted(reflect(substrate, cosine), sample.weight, &bare);
            }
            for (const double change :
                 {with.Rs - bare.Rs, with.Rp - bare.Rp, with.C - bare.C, with.S - bare.S}) {
                largest = std::max(largest, std::abs(change));
            }
        }
    }
    return largest;
}

}  // namespace drude
