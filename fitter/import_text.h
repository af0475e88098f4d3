// The text that instruments export, cut into lines, words and numbers with their places.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.h"
#include "materials/measurement.h"

namespace drude {

struct TextLine {
    std::string_view text;  // without the line break
    int number = 0;         // from 1
};

struct Word {
    std::string_view text;
    int column = 0;  // from 1, in bytes
};

// The lines of `text`, blank ones included, without a byte order mark; LF and CRLF. The views
// point into `text`.
std::vector<TextLine> lines_of(std::string_view text);

// The words of a line between blanks and tabs.
std::vector<Word> split_blanks(std::string_view line);
// The fields of a line between separators, without the blanks around them; empty ones are kept.
std::vector<Word> split_fields(std::string_view line, char separator);

// At most 40 characters, printable in any encoding, for messages.
std::string shown(std::string_view text);
// ASCII letters to lower case; other bytes are kept.
std::string lower_case(std::string_view text);
// UTF-8 as it is, everything else read as Latin-1 (as instruments on old Windows write degrees and
// micrometres): for names that are kept.
std::string utf8(std::string_view text);

// The finite number that the whole word spells, with a decimal point or a decimal comma; nothing
// otherwise.
std::optional<double> number_in(std::string_view text);
// The same; throws Error (user) at the word's place otherwise, NaN and infinities included.
double parse_number(const Word& word, const Place& line);
// The number times 10^power, rounded once: "0.4358" with power 3 is 435.8 to the last bit.
double parse_scaled(const Word& word, const Place& line, int power);

// What a spectral axis is in. nm, Angstroms, micrometres and 1/cm are lengths of vacuum; eV is
// photon energy, lambda = hc/E with hc = 1239.841984... eV nm (exact in the SI of 2019).
enum class SpectralUnit { nm, angstrom, micrometre, electronvolt, per_centimetre };
// By any usual spelling ("nm", "Angstroms", "A", "eV", "um", "microns", "1/cm"), letter case free.
std::optional<SpectralUnit> spectral_unit(std::string_view word);
// The vacuum wavelength in nm; throws Error (user) at the word's place for what is not above 0.
double parse_wavelength_nm(const Word& word, const Place& line, SpectralUnit unit);

// What a reader changed or left out, kept as "# warning: ..." in the measurement's own file.
void add_warning(Measurement& measurement, std::string text);

}  // namespace drude
