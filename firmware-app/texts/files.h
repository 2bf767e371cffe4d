#pragma once
// Where a programme's files come from: a folder, or the program itself (the default programme).
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "firmware-app/texts/messages.h"

namespace caryatid::app {

struct BuiltinFile {
  std::string_view name;  // "texts/en.toml"
  std::string_view bytes;
};

class ProgrammeFiles {
 public:
  // config: path of kiosk.toml; empty: the built-in files, of them the one of this name.
  ProgrammeFiles(const std::string& config, std::vector<BuiltinFile> builtin,
                 const std::string& builtin_config = "kiosk.toml");

  // Name of the configuration file, for reading and messages.
  const std::string& config() const { return config_; }
  // Reads a file that is named relative to the configuration's folder. At most `most_bytes`.
  // False: one line in out_error, without the file's name.
  bool read(const std::string& name, std::size_t most_bytes, std::string* out,
            std::string* out_error);
  bool exists(const std::string& name) const;
  // Full names of everything read so far: what a reload has to watch.
  const std::vector<std::string>& names_read() const { return read_; }
  std::string full_name(const std::string& name) const { return folder_ + name; }
  bool builtin() const { return builtin_used_; }

 private:
  std::string config_, folder_;
  bool builtin_used_ = false;
  std::vector<BuiltinFile> builtin_;
  std::vector<std::string> read_;
};

// Replaces what is no UTF-8 by U+FFFD; the line of the first such byte, or 0.
std::size_t mend_utf8(std::string* io_text);

}  // namespace caryatid::app
