#pragma once

#include "formats/page_payload.h"

namespace mane {

class CacheReader;

/// The contacts of a run with `--record`, all frames one after the other. Nothing for a run
/// without.
void add_contacts(const CacheReader& run, PagePayload& payload);

} // namespace mane
