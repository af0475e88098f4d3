// What is chosen by itself draws the pictures of the richest model.
#include "bench/charts/defaults_item.h"

#include <gtest/gtest.h>

#include "image/compare.h"

namespace drude {
namespace {

// Scenes that need no file beside their own.
class Defaults : public testing::TestWithParam<const char*> {};

TEST_P(Defaults, DrawThePictureOfTheRichestModel) {
    const Scene scene = small_scene(GetParam(), 20);
    RenderOptions by_default, richest = richest_options();
    by_default.samples_per_pixel = richest.samples_per_pixel = 512;
    by_default.quiet = richest.quiet = true;
    by_default.seed = 1;
    richest.seed = 2;
    const RenderResult cheap = render(scene, by_default), rich = render(scene, richest);
    EXPECT_LT(cheap.wavelengths, rich.wavelengths);
    CompareOptions how;
    how.any_scene = true;
    const Comparison compared = compare_images(cheap.image, rich.image, "default", "richest", how);
    EXPECT_TRUE(compared.same) << compared.reason;
}

INSTANTIATE_TEST_SUITE_P(Scenes, Defaults,
                         testing::Values("half-sphere", "furnace", "two-metals", "cornell-metals"),
                         [](const auto& scene) {
                             std::string name = scene.param;
                             for (char& c : name) c = c == '-' ? '_' : c;
                             return name;
                         });

}  // namespace
}  // namespace drude
