#include "fitter/export.h"
#include "fitter/import_constants.h"
#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    return drude::fuzz_one(data, size, [](const std::string& text) {
        const drude::Material material = drude::parse_constants_as(text, "fuzz", "refractiveindex");
        drude::format_refractiveindex_info(material.substrate);
    });
}
