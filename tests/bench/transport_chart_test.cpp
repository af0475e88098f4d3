// Where scalar is exact and where it is not, as the chart of transport finds it.
#include "bench/charts/transport_chart.h"

#include <gtest/gtest.h>

#include <cmath>

#include "bench/charts/chart_scenes.h"
#include "materials/fresnel.h"

namespace drude {
namespace {

ReferencePicture reference_of(const TracedScene& scene, int samples) {
    const auto tracer = make_batch_tracer(Transport::stokes, 8, scene.setup(77));
    return trace_reference(*tracer, scene.scene().film, 4, samples);
}

TEST(TransportChart, ScalarIsExactOnTheHalfSphere) {
    const TracedScene scene(half_sphere_in_courtyard(
        12, 12,
        "Material \"conductor\" \"string material\" \"Cu\" \"string lobe\" \"gaussian\" \"float "
        "beta\" 0.2"));
    const ReferencePicture reference = reference_of(scene, 64);
    for (const Transport transport : {Transport::scalar, Transport::intensity}) {
        const TransportBias bias = transport_bias(scene, transport, 32, 2, 1, reference);
        EXPECT_TRUE(bias.is_exact()) << bias.largest;
        EXPECT_LT(std::abs(bias.mean), 1e-6);
    }
}

// All six windows show a quarter of the panel where polarisation is forgotten, but 1/2, 1/4, 0,
// 1/2, 1/4 and 0 where it is not.
TEST(TransportChart, ScalarIsWrongBehindPolarisers) {
    const TracedScene scene(chart_scene("crossed-polarisers", 24, 18));
    const ReferencePicture reference = reference_of(scene, 128);
    const TransportBias scalar = transport_bias(scene, Transport::scalar, 32, 2, 1, reference);
    EXPECT_FALSE(scalar.is_exact());
    EXPECT_GT(scalar.rms, 0.3);
    const TransportBias intensity =
        transport_bias(scene, Transport::intensity, 32, 2, 1, reference);
    EXPECT_TRUE(intensity.is_exact()) << intensity.largest;
}

// Two mirrors at right angles, seen along the line between them: every ray is reflected twice at 45
// degrees in one plane and brings (Rs^2 + Rp^2)/2 of the sky, of which scalar sees ((Rs + Rp)/2)^2.
TEST(TransportChart, ScalarIsTooDarkInAWedgeByWhatIsKnown) {
    const TracedScene scene(parse_scene(
        "LookAt 0 0 5  0 0 0  0 1 0\nCamera \"orthographic\" \"float screenwindow\" "
        "[-0.5 0.5 -0.5 0.5]\nFilm \"rgb\" \"integer xresolution\" 4 \"integer yresolution\" "
        "4\nPixelFilter \"box\"\nIntegrator \"path\" \"integer maxdepth\" 5\nWorldBegin\n"
        "LightSource \"infinite\" \"rgb L\" [1 1 1]\n"
        "Material \"conductor\" \"spectrum eta\" [300 1 900 1] \"spectrum k\" [300 2 900 2] "
        "\"float roughness\" 0\n"
        "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 0 3 4 0 4 5]\n"
        "\"point3 P\" [0 -3 0  2 -3 2  2 3 2  0 3 0  -2 3 2  -2 -3 2]\n",
        "wedge.pbrt"));
    const ReferencePicture reference = reference_of(scene, 32);
    const TransportBias bias = transport_bias(scene, Transport::scalar, 16, 2, 1, reference);
    const auto r = reflect(ComplexIndex<double>{1, 2}, std::sqrt(0.5));
    const double exact = (r.Rs * r.Rs + r.Rp * r.Rp) / 2;
    EXPECT_LT(r.A() * r.A() / exact - 1, -0.01);
    EXPECT_NEAR(bias.mean, r.A() * r.A() / exact - 1, 1e-5);
    EXPECT_LT(bias.sigma, 1e-6);
}

TracedPicture flat_picture(double value) {
    TracedPicture picture;
    picture.width = 2;
    picture.height = 1;
    picture.values.assign(6, value);
    return picture;
}

// Every pixel off by a tenth: 3 * 0.1^2 over 3 + a hundredth of 3.
TEST(RelativeRmse, IsThatOfTheDefinition) {
    const ReferencePicture reference{flat_picture(1), flat_picture(1), 2};
    EXPECT_NEAR(relative_rmse(flat_picture(1.1), reference), 0.1 / std::sqrt(1.01), 1e-12);
    EXPECT_EQ(relative_rmse(flat_picture(1), reference), 0);
}

// Halves that are off by as much to either side tell nothing: neither does a picture between.
TEST(RelativeRmse, LeavesOutTheReferencesNoise) {
    const ReferencePicture reference{flat_picture(0.9), flat_picture(1.1), 2};
    EXPECT_TRUE(std::isnan(relative_rmse(flat_picture(1), reference)));
    // (1.3 - 0.9)(1.3 - 1.1) = 0.08, against 0.09 of the mean: less the halves' own 0.01.
    EXPECT_NEAR(relative_product(flat_picture(1.3), flat_picture(1.3), reference), 0.08 / 1.01,
                1e-12);
}

}  // namespace
}  // namespace drude
