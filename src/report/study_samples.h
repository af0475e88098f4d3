// The five metals of the study.
#pragma once

#include <vector>

#include "materials/material.h"

namespace drude {

struct StudySample {
    const char* name;
    const char* folder;
    const char* set;         // what the virtual sample is made of
    const char* literature;  // what it is compared with
    Lobe lobe;
    double beta;  // of its lobe (conventions of microfacet.h)
};

// Two independent publications for each metal: one stands for the sample on the table, the other
// for the handbook. V-grooves mask as in Berger et al. 2012; lobes and betas are those of a finish
// between brushed and blasted, each another one.
const std::vector<StudySample>& study_samples();

// The rough surface on the table.
Material made_of(const StudySample& sample);

}  // namespace drude
