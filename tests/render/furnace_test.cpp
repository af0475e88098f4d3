// White furnace: a lobe of perfect mirrors (Rs = Rp = 1) under a constant sky shows the sky times
// the lobe's directional albedo, which is integrated here by other means than the renderer's.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "materials/microfacet.h"
#include "test_scenes.h"

namespace drude {
namespace {

// Integral over the hemisphere of i of D G2 / (4 cos o), in half-vector coordinates: with slopes
// p = (x, y) = m.xy / m.z, dm = m.z^3 dp and di = 4 (o.m) dm. Polar in p with a substitution that
// follows the lobe's width from 1e-4 to 1.
double directional_albedo(const Microfacets<double>& lobe, double cos_o, double scale) {
    const Vec3<double> o(std::sqrt(1 - cos_o * cos_o), 0, cos_o);
    // tan = scale * s / (1 - s), s in (0, 1); midpoint rule in s and phi.
    constexpr int ns = 400, np = 48;  // half a turn: the other half is its mirror image
    double total = 0;
    for (int a = 0; a < ns; ++a) {
        const double s = (a + 0.5) / ns, t = scale * s / (1 - s);
        const double dt = scale / ((1 - s) * (1 - s)) / ns;
        const double z = 1 / std::sqrt(1 + t * t);
        for (int b = 0; b < np; ++b) {
            const double phi = pi * (b + 0.5) / np;
            const Vec3<double> m(t * z * std::cos(phi), t * z * std::sin(phi), z);
            const double om = glm::dot(o, m);
            if (om <= 0) continue;
            const Vec3<double> i = 2 * om * m - o;
            if (i.z <= 0) continue;
            total += lobe.D(m) * lobe.G2(o, i, m) * om / o.z * z * z * z * t * dt * (2 * pi / np);
        }
    }
    return total;
}

struct Case {
    Lobe lobe;
    Masking masking;
};

class Furnace : public testing::TestWithParam<Case> {};

TEST_P(Furnace, ShowsTheDirectionalAlbedo) {
    const auto [lobe, masking] = GetParam();
    for (const double beta : {0.0, 1e-4, 0.01, 0.03, 0.1, 0.3, 1.0}) {
        SCOPED_TRACE(fmt::format("beta {}", beta));
        const Scene scene = sphere_under_sky(
            fmt::format("Material \"conductor\" \"rgb reflectance\" [1 1 1] \"string lobe\" \"{}\" "
                        "\"string masking\" \"{}\" \"float beta\" {}",
                        lobe_name(lobe), masking_name(masking), beta),
            24);
        const RenderResult result = render_quietly(scene, 512);
        const Microfacets<double> exact(lobe, masking, beta);
        // Expected: the mean over the same pixels of the albedo at the pixel's angle, from a table
        // over the cosine.
        constexpr int cells = 96;
        std::vector<double> albedo(cells + 1, 1.0);
        if (beta > 0) {
            for (int c = 0; c <= cells; ++c) {
                albedo[c] = directional_albedo(exact, std::max(0.005, double(c) / cells), beta);
            }
        }
        double rendered = 0, expected = 0;
        int pixels = 0;
        const double t = std::tan(16 * pi / 180);
        for (int y = 0; y < 24; ++y) {
            for (int x = 0; x < 24; ++x) {
                double mean = 0;
                bool inside = true;
                constexpr int grid = 8;
                for (int j = 0; j < grid * grid && inside; ++j) {
                    const double sx = (2 * (x + (j % grid + 0.5) / grid) / 24 - 1) * t;
                    const double sy = (1 - 2 * (y + (j / grid + 0.5) / grid) / 24) * t;
                    const double dz = 1 / std::sqrt(sx * sx + sy * sy + 1);
                    const double gap = 16 * dz * dz - 15;
                    // Well inside the silhouette: the table ends near grazing.
                    inside = gap > 0.02;
                    const double cosine = inside ? std::sqrt(gap) : 0;
                    const double at = cosine * cells;
                    const int cell = std::min(cells - 1, static_cast<int>(at));
                    mean += albedo[cell] + (at - cell) * (albedo[cell + 1] - albedo[cell]);
                }
                if (!inside) continue;
                ++pixels;
                expected += mean / (grid * grid);
                rendered += result.image.find("G")->data[static_cast<size_t>(y) * 24 + x];
            }
        }
        ASSERT_GT(pixels, 150);
        EXPECT_NEAR(rendered / pixels, expected / pixels, 1e-3);
        EXPECT_LE(expected / pixels, 1 + 1e-4);
    }
}

INSTANTIATE_TEST_SUITE_P(Lobes, Furnace,
                         testing::Values(Case{Lobe::blinn_phong, Masking::v_groove},
                                         Case{Lobe::gaussian, Masking::v_groove},
                                         Case{Lobe::beckmann, Masking::v_groove},
                                         Case{Lobe::beckmann, Masking::smith},
                                         Case{Lobe::trowbridge_reitz, Masking::v_groove},
                                         Case{Lobe::trowbridge_reitz, Masking::smith}));

}  // namespace
}  // namespace drude
