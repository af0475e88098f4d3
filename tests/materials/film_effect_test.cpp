#include "materials/film_effect.h"

#include <gtest/gtest.h>

#include <cmath>

#include "materials/film_stack.h"

namespace drude {
namespace {

Material on_copper(double thickness_nm) {
    Material material = find_material("Cu-McPeak");
    material.layers = {{published_set("Al2O3-Malitson-o"), thickness_nm, 0}};
    return material;
}

TEST(FilmEffect, IsNothingWithoutAFilm) {
    EXPECT_EQ(film_effect(find_material("Cu-McPeak")), 0);
    EXPECT_LT(film_effect(on_copper(0)), 1e-12);
}

TEST(FilmEffect, GrowsInProportionToAThinFilm) {
    // First order in d/lambda (Drude 1891).
    const double at_1pm = film_effect(on_copper(1e-3)), at_4pm = film_effect(on_copper(4e-3));
    EXPECT_NEAR(at_4pm / at_1pm, 4, 0.02);
    EXPECT_GT(at_1pm, 1e-5);
}

TEST(FilmEffect, IsTheLargestChangeOfAnyElement) {
    const Material material = on_copper(60);
    const double effect = film_effect(material);
    EXPECT_LE(effect, 2);
    for (const double nm : {400.0, 550.0, 700.0}) {
        const Index film = material.layers[0].constants.at(nm), base = material.substrate.at(nm);
        const ThinFilm<double> layer{{film.n, film.k}, 60};
        const ComplexIndex<double> metal{base.n, base.k};
        const Reflection<double> with = reflect(&layer, 1, metal, 0.5, nm);
        const Reflection<double> bare = reflect(metal, 0.5);
        // A nanometre's mean beside its middle, and angles beside those looked at.
        EXPECT_LE(std::abs(with.C - bare.C), effect + 5e-3);
        EXPECT_LE(std::abs(with.Rp - bare.Rp), effect + 5e-3);
    }
}

TEST(FilmEffect, AFilmLikeItsMetalChangesNothing) {
    Material material = find_material("Cu-McPeak");
    material.layers = {{material.substrate, 25, 0}};
    EXPECT_LT(film_effect(material), 1e-12);
}

}  // namespace
}  // namespace drude
