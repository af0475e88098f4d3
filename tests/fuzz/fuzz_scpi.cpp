#include "device/instruments/scpi_format.h"
#include "device/instruments/scpi_head.h"
#include "fuzz_device.h"

// The first byte chooses the format; the rest is an answer.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    if (size == 0) return 0;
    const std::string answer(data + 1, data + size);
    constexpr drude::ScpiFormat formats[] = {drude::ScpiFormat::ascii, drude::ScpiFormat::real32,
                                             drude::ScpiFormat::real64};
    drude::fuzz_answer([&] {
        const std::vector<double> numbers =
            drude::parse_scpi_numbers(answer, formats[data[0] % 3], (data[0] & 0x80) != 0, "fuzz");
        if (numbers.empty()) std::abort();
        drude::fuzz_answer([&] { drude::scpi_counts(numbers, numbers.size(), 65535, "fuzz"); });
        for (const size_t columns : {3u, 5u, 6u}) {
            std::vector<double> wavelengths;
            for (size_t at = 0; at < numbers.size(); at += columns) {
                wavelengths.push_back(numbers[at]);
            }
            drude::fuzz_answer([&] {
                for (const auto& row : drude::scpi_rows(numbers, wavelengths, 70, "fuzz")) {
                    if (!(row.psi_deg >= 0 && row.psi_deg <= 90)) std::abort();
                }
            });
        }
    });
    drude::fuzz_answer([&] { drude::scpi_error_words(drude::parse_scpi_error(answer, "fuzz")); });
    drude::fuzz_answer([&] {
        if (drude::parse_scpi_identity(answer, "fuzz").str().size() > answer.size() + 3) {
            std::abort();
        }
    });
    return 0;
}
