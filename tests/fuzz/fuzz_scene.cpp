// Scenes that name no file: what stands in a file of its own has a target of its own.
#include "fuzz.h"
#include "scene/scene.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    return drude::fuzz_one(
        data, size, [](const std::string& text) { drude::parse_scene(text, "nowhere/fuzz.pbrt"); });
}
