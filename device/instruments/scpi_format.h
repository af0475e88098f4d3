// What SCPI instruments answer: numbers, blocks, errors (IEEE 488.2-1992, 8.7; SCPI-99).
//
// Everything here throws DeviceError (bad_frame), its message beginning with `where`, for text that
// is not what it should be.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace drude {

// How numbers come: as text with commas, or as a block of floats.
enum class ScpiFormat { ascii, real32, real64 };

// The contents of a definite-length block, "#<digits><length><bytes>": "#15hello" holds "hello".
// Strict: one digit 1 to 9, that many decimal digits, exactly so many bytes, then nothing but an
// optional line feed. Blocks of indefinite length ("#0") are refused, since a lost end of such a
// block cannot be told from its end.
std::string_view parse_scpi_block(std::string_view answer, const std::string& where);

// A decimal number; 9.91E37 is NaN, 9.9E37 and -9.9E37 are the infinities (SCPI-99, 7.2.1.4 and
// 7.2.1.5), which are also taken by their names NAN, INF, NINF. White space around is allowed.
double parse_scpi_number(std::string_view text, const std::string& where);

// Numbers separated by commas, bare or in a block, or a block of floats, most significant byte
// first unless `swapped`. An answer without any number is an error.
std::vector<double> parse_scpi_numbers(std::string_view answer, ScpiFormat format, bool swapped,
                                       const std::string& where);

// "-222,\"Data out of range\"": what SYSTem:ERRor? answers; the text may be missing.
struct ScpiError {
    int code = 0;  // 0: the queue is empty
    std::string text;
};
ScpiError parse_scpi_error(std::string_view answer, const std::string& where);
// "-222, data out of range", with what the standard calls the class of the code where the text is
// missing.
std::string scpi_error_words(const ScpiError& error);

// "maker,model,serial,firmware", as *IDN? answers; fields that are missing are empty.
struct ScpiIdentity {
    std::string maker, model, serial, firmware;

    std::string str() const;  // "maker, model, serial, firmware", without the empty ones
};
ScpiIdentity parse_scpi_identity(std::string_view answer, const std::string& where);

}  // namespace drude
