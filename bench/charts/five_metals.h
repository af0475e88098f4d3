// The metals of the pictures.
#pragma once

#include <string>
#include <vector>

namespace drude {

struct NamedMetal {
    std::string name, set;
};

// Copper, silver, gold, aluminium and the zinc of coated steel: what the samples of the study are
// made of.
inline const std::vector<NamedMetal>& five_metals() {
    static const std::vector<NamedMetal> metals = {{"Cu", "Cu-McPeak"},
                                                   {"Ag", "Ag-McPeak"},
                                                   {"Au", "Au-McPeak"},
                                                   {"Al", "Al-McPeak"},
                                                   {"Zn on steel", "Zn-Werner-DFT"}};
    return metals;
}

}  // namespace drude
