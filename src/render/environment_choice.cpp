#include "render/environment_choice.h"

#include "base/files.h"
#include "base/sha256.h"
#include "image/image.h"
#include "render/courtyard.h"

namespace drude {

void replace_environment(Scene* scene, const std::string& environment, int threads) {
    InfiniteLight light;
    if (!scene->infinite_lights.empty()) {
        light.world_from_light = scene->infinite_lights.front().world_from_light;
    }
    light.image = environment;
    std::string content = environment;
    if (environment == courtyard_name) {
        light.picture = std::make_shared<const Image>(make_courtyard(1024, threads));
    } else {
        light.picture = std::make_shared<const Image>(read_image(environment));
        content = read_file(environment);
    }
    scene->infinite_lights.clear();
    scene->infinite_lights.push_back(std::move(light));
    scene->sha256 = sha256(scene->sha256 + sha256(content));
}

}  // namespace drude
