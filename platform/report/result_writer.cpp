#include <report/result_writer.h>

#include <fcntl.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include <report/file_output.h>
#include <report/result_parts.h>
#include <vp/error.h>

namespace platform::report {

namespace {

constexpr int indent = 2;

/// File names may hold any bytes; JSON holds UTF-8 only.
std::string dump(const Json& json, int spaces = -1) {
  return json.dump(spaces, ' ', false, Json::error_handler_t::replace);
}

/// The members of `json` as lines of an object that goes on after them.
std::string opened(const Json& json) {
  std::string text = dump(json, indent);
  text.erase(text.size() - 2);  // the last line feed and brace
  return text + ",\n";
}

/// A file without a name, where the results go: a system's folder for temporary files may be small
/// or slow. Not every file system has such files.
std::FILE* nameless_file(const std::string& folder) {
  const int descriptor = ::open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
  return descriptor < 0 ? std::tmpfile() : ::fdopen(descriptor, "w+");
}

}  // namespace

ResultWriter::ResultWriter(const std::string& folder)
    : path_((std::filesystem::path(folder) / "result.json").string()),
      frames_(nameless_file(folder)) {
  if (!frames_) throw vp::InputError(std::string("no temporary file: ") + std::strerror(errno));
}

ResultWriter::~ResultWriter() = default;

void ResultWriter::add(const FrameReport& frame) {
  const std::string text = (summary_.frames() == 0 ? "\n    " : ",\n    ") + dump(to_json(frame));
  if (std::fwrite(text.data(), 1, text.size(), frames_.get()) != text.size()) {
    throw vp::InputError(std::string("temporary file: ") + std::strerror(errno));
  }
  summary_.add(frame);
}

void ResultWriter::finish(const RunFacts& facts, const Provenance& provenance,
                          const std::vector<std::string>& warnings,
                          const std::optional<std::string>& incomplete) {
  Json head;
  head["schema"] = result_schema;
  head["provenance"] = to_json(provenance);
  add_run(head, facts);
  head["configuration"] = Json::object();
  for (const auto& [path, value] : facts.configuration) head["configuration"][path] = value;
  add_end(head, facts, warnings, incomplete);

  AtomicFile file(path_);
  file.write(opened(head) + "  \"frames\": [");
  std::rewind(frames_.get());
  std::array<char, 1 << 16> block;
  while (const std::size_t size = std::fread(block.data(), 1, block.size(), frames_.get())) {
    file.write({block.data(), size});
  }
  if (std::ferror(frames_.get())) {
    throw vp::InputError(std::string("temporary file: ") + std::strerror(errno));
  }
  Json tail;
  add_figures(tail, facts, summary_);
  file.write(summary_.frames() == 0 ? "],\n" : "\n  ],\n");
  file.write(dump(tail, indent).substr(2) + "\n");
  file.commit();
}

}  // namespace platform::report
