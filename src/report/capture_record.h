// What study.json says of a sample's captures: how a sweep went, and what a lobe scan was fitted
// with.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "materials/json_tree.h"
#include "report/study_data.h"

namespace drude {

nlohmann::ordered_json capture_json(const StudyCapture& capture);
StudyCapture read_capture(const JsonValue& value);

// The capture and the fit; scan, sample and surface are files of their own.
nlohmann::ordered_json lobe_json(const StudyLobe& lobe);
StudyLobe read_lobe(const JsonValue& value);

}  // namespace drude
