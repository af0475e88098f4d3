// Material files.
#include "fuzz.h"
#include "materials/material.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    return drude::fuzz_one(data, size, [](const std::string& text) {
        const drude::Material material = drude::parse_material(text, "fuzz.json");
        // What was read says no less when it is written.
        drude::parse_material(drude::format_material(material), "again.json");
    });
}
