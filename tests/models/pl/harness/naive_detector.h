#pragma once

#include <cstdint>
#include <vector>

#include "frames.h"
#include "word.h"

namespace harness {

/// Corner and binary words of a frame by their plain definition, each at the clock at which it must
/// leave: written without looking at the models, from the whole picture.
std::vector<Word> naive_words(const Image& image, int width, int height, unsigned corner_threshold,
                              unsigned grey_threshold);

}  // namespace harness
