#include "fitter/import_table.h"

#include "fuzz.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    return drude::fuzz_one(data, size, [](const std::string& text) {
        drude::format_measurement(drude::parse_named_table(text, "fuzz"));
    });
}
