#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include <marker/code_book.h>

namespace platform::input {

/// Markers of one's own: words as marker::Dictionary has them.
struct OwnDictionary {
  std::string name;            ///< of the file, without folders and extension
  std::uint32_t cells = 0;     ///< of the code's side
  std::uint32_t border = 0;    ///< width of the black border, cells; 0: the file does not say
  std::uint32_t distance = 0;  ///< least number of cells in which two words differ, however turned
  std::vector<std::uint64_t> words;
};

/// The words for the software, without their border; `own` must outlive them.
marker::Dictionary as_dictionary(const OwnDictionary& own);

/// Reads the words of markers:
///
///   OpenCV      as Dictionary::writeDictionary() has them (`nmarkers`, `markersize`, `marker_0`
///   …),
///               or its members (`MarkerSize`, `ByteList`), in YAML, XML or JSON
///   AprilTag    the C source of a family (tag36h10.c), of version 2 or 3
///
/// Throws vp::InputError: missing, malformed, of another format; codes that are no square of 3 to 7
/// cells inside of the border, as those of AprilTag's Standard, Circle and Custom families; more
/// words than a program has room for; two words that are the same marker, or a black one.
OwnDictionary read_dictionary_file(const std::string& path);

}  // namespace platform::input
