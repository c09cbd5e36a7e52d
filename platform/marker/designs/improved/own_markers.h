#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include <marker/code_book.h>
#include <marker/input/dictionary_file.h>

namespace platform {

/// The dictionary that the option `dictionary_file` of the program `improved` names, if any, and
/// what its other options say of the markers.
class OwnMarkers {
 public:
  /// What the program gets of the file: improved::DictionaryData and the words. Throws
  /// vp::InputError.
  std::string read(const std::string& path);

  /// Takes the program's options, in their order. Throws vp::InputError if one of them says
  /// something else than the file, or a border that is too wide.
  void check(const std::string& option, double value);

  /// Null: no file is named.
  const marker::Dictionary* dictionary() const { return words_ ? &*words_ : nullptr; }

 private:
  input::OwnDictionary own_;
  std::optional<marker::Dictionary> words_;
  std::uint32_t cells_ = 0;  ///< of the code's side
};

}  // namespace platform
