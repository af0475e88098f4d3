// The result of a run as JUnit's XML, which CI systems read.
#pragma once

#include <string>

#include "regress/regress.h"

namespace drude {

// One test suite; a case that failed, is weak or has no reference is a <failure>, one that could
// not be run an <error>, each with the commands to look closer; one that was not reached <skipped>.
// Times in seconds.
std::string junit_xml(const RegressResult& run);

}  // namespace drude
