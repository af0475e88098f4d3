#include "fitter/import_accurion.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    return drude::fuzz_one(data, size, [](const std::string& text) {
        drude::format_measurement(drude::parse_accurion(text, "fuzz"));
    });
}
