// The first record of a journal as JSON.
#pragma once

#include <string>

#include "device/sweep/journal.h"

namespace drude {

// Canonical: the same header gives the same bytes.
std::string format_journal_header(const JournalHeader& header);

// Throws Error (user) for what format_journal_header() does not write; `where` names it.
JournalHeader parse_journal_header(const std::string& json, const std::string& where);

}  // namespace drude
