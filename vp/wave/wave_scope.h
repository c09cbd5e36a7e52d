#pragma once

#include <vp/wave_writer.h>

#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace vp {

struct WaveDeclaration {
  std::string path;
  WaveWriter::Kind kind;
  unsigned width;
};

/// A level of the hierarchy, in the order of declaration.
struct WaveScope {
  std::string name;
  std::vector<std::pair<std::string, WaveWriter::Id>> variables;
  std::vector<std::unique_ptr<WaveScope>> children;

  /// All declarations below one root without name.
  static WaveScope of(const std::vector<WaveDeclaration>& declarations) {
    WaveScope root;
    for (std::size_t id = 0; id < declarations.size(); ++id) {
      std::string_view rest = declarations[id].path;
      WaveScope* scope = &root;
      for (auto dot = rest.find('.'); dot != std::string_view::npos; dot = rest.find('.')) {
        scope = &scope->child(rest.substr(0, dot));
        rest.remove_prefix(dot + 1);
      }
      scope->variables.emplace_back(rest, static_cast<WaveWriter::Id>(id));
    }
    return root;
  }

  WaveScope& child(std::string_view child_name) {
    for (auto it = children.rbegin(); it != children.rend(); ++it) {
      if ((*it)->name == child_name) return **it;
    }
    children.push_back(std::make_unique<WaveScope>());
    children.back()->name = child_name;
    return *children.back();
  }
};

/// The declaration, checked. Throws std::invalid_argument.
inline WaveDeclaration checked_declaration(std::string_view path, WaveWriter::Kind kind,
                                           unsigned width) {
  bool valid = !path.empty() && path.front() != '.' && path.back() != '.' &&
               path.find("..") == std::string_view::npos;
  for (const char c : path) valid = valid && c > ' ' && c <= '~';
  if (!valid) throw std::invalid_argument("not a name for a trace: '" + std::string(path) + "'");
  if (kind == WaveWriter::Kind::real) width = 64;
  if (kind == WaveWriter::Kind::text) width = 1;
  if (width < 1 || width > WaveWriter::widest) {
    throw std::invalid_argument("width of '" + std::string(path) + "' is not 1 to " +
                                std::to_string(WaveWriter::widest) + " bits");
  }
  return {std::string(path), kind, width};
}

/// Writes GTKWave's FST through its own fstapi: some 30 times smaller than a VCD. Throws
/// OutputError if the file cannot be written.
std::unique_ptr<WaveWriter> open_fst_writer(const std::filesystem::path& file);

}  // namespace vp
