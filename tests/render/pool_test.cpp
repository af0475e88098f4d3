// What lives while a picture is rendered must leave the threads to the rendering.
#include <gtest/gtest.h>

#include "base/threads_at_work.h"
#include "render/geometry.h"
#include "test_scenes.h"

namespace drude {
namespace {

TEST(Pool, IsNotLimitedByEmbree) {
    const Scene scene = sphere_under_sky("Material \"diffuse\"", 4);
    const Geometry geometry(scene);
    EXPECT_EQ(threads_at_work(2), 2U);
    EXPECT_EQ(threads_at_work(5), 5U);
}

}  // namespace
}  // namespace drude
