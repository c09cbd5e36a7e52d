#pragma once

#include <trace/vocabulary.h>

namespace platform {

/// The words of the marker designs.
const trace::Vocabulary& marker_words();

}  // namespace platform
