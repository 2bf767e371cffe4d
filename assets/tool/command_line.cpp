#include "assets/tool/command_line.h"

#include <cstdio>
#include <filesystem>
#include <map>

#include "assets/bake/files/files.h"
#include "assets/tool/numbers.h"

namespace caryatid::tool {
namespace {

namespace fs = std::filesystem;

struct Use {
  enum class Kind { in, frame_in, out } kind = Kind::in;
  std::vector<std::string> endings;
};

// Options live as long as the program.
std::map<const CLI::Option*, Use>& uses() {
  static std::map<const CLI::Option*, Use> map;
  return map;
}

CLI::Option* mark(CLI::Option* option, Use::Kind kind,
                  const std::vector<std::string>& endings = {}) {
  uses()[option] = {kind, endings};
  return option;
}

bool regular_or_new(const std::string& path) {
  std::error_code error;
  return !fs::exists(path, error) || fs::is_regular_file(path, error);
}

bool same_file(const std::string& a, const std::string& b) {
  std::error_code error;
  if (!regular_or_new(a) || !regular_or_new(b)) return false;  // /dev/null takes everything.
  if (fs::equivalent(a, b, error)) return true;
  return fs::weakly_canonical(fs::absolute(a), error) ==
         fs::weakly_canonical(fs::absolute(b), error);
}

void check_ending(const CLI::Option& option, const std::string& path,
                  const std::vector<std::string>& endings) {
  if (endings.empty() || !regular_or_new(path)) return;
  std::string all;
  for (const std::string& ending : endings) {
    if (path.ends_with(ending)) return;
    all += (all.empty() ? "" : " or ") + ending;
  }
  throw UsageError(option.get_name() + " " + path + ": " + all +
                   " is written; end the name with that");
}

// Bytes of the UTF-8 character at `at`; 0 when there is none, or one that no text has.
std::size_t utf8_length(const std::string& text, std::size_t at) {
  const auto byte = [&](std::size_t i) {
    return at + i < text.size() ? static_cast<unsigned char>(text[at + i]) : 0u;
  };
  const unsigned lead = byte(0);
  if (lead < 0x80) return 1;
  const std::size_t length = lead >= 0xF0 ? 4 : (lead >= 0xE0 ? 3 : 2);
  if (lead < 0xC2 || lead > 0xF4) return 0;
  std::uint32_t code = lead & (0x7Fu >> length);
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0u) != 0x80) return 0;
    code = code << 6u | (byte(i) & 0x3Fu);
  }
  const std::uint32_t least = length == 4 ? 0x10000 : (length == 3 ? 0x800 : 0x80);
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code < least || code > 0x10FFFF || surrogate ? 0 : length;
}

}  // namespace

CLI::Option* reads(CLI::Option* option) { return mark(option, Use::Kind::in); }
CLI::Option* reads_frame(CLI::Option* option) { return mark(option, Use::Kind::frame_in); }
CLI::Option* writes(CLI::Option* option, const std::vector<std::string>& endings) {
  return mark(option, Use::Kind::out, endings);
}

void claim(const std::vector<std::string>& inputs, const std::vector<std::string>& outputs) {
  for (const std::string& in : inputs)
    if (const std::string why = bake::why_unreadable(in); !why.empty())
      throw std::runtime_error(in + ": " + why);
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    const std::string& out = outputs[i];
    if (const std::string why = bake::why_unwritable(out); !why.empty())
      throw std::runtime_error(out + ": " + why);
    for (const std::string& in : inputs)
      if (same_file(in, out))
        throw UsageError(out + ": would be written over the input; name another file");
    for (std::size_t k = 0; k < i; ++k)
      if (same_file(outputs[k], out))
        throw UsageError(out + ": would be written twice; name another file");
  }
}

void on_run(CLI::App* cmd, const std::function<void()>& work) {
  cmd->callback([cmd, work] {
    std::vector<std::string> inputs, outputs;
    for (const CLI::Option* option : cmd->get_options()) {
      const auto use = uses().find(option);
      if (use == uses().end() || option->count() == 0) continue;
      for (const std::string& path : option->results()) {
        if (use->second.kind == Use::Kind::frame_in) {
          inputs.push_back(frame_name(path).path);
        } else if (use->second.kind == Use::Kind::in) {
          inputs.push_back(path);
        } else {
          check_ending(*option, path, use->second.endings);
          outputs.push_back(path);
        }
      }
    }
    claim(inputs, outputs);
    work();
  });
}

FrameName frame_name(const std::string& text) {
  std::error_code error;
  const std::size_t at = text.rfind('@');
  if (at == std::string::npos || fs::exists(text, error)) return {text, 0};
  const std::string number = text.substr(at + 1);
  if (number.empty() || number.size() > 9 ||
      number.find_first_not_of("0123456789") != std::string::npos)
    throw UsageError(text + ": wanted FILE or FILE@FRAME with a frame from 0");
  return {text.substr(0, at), std::stoul(number)};
}

void check_text(const std::string& option, const std::string& text) {
  bool says = false;
  for (std::size_t at = 0, length = 0; at < text.size(); at += length) {
    length = utf8_length(text, at);
    if (length == 0)
      throw UsageError(option + ": byte " + std::to_string(at + 1) + " of the text is no UTF-8");
    says = says || length > 1 || std::isalnum(static_cast<unsigned char>(text[at])) != 0;
  }
  if (!says) throw UsageError(option + ": there is nothing to say in the text");
}

std::string printable(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    const auto byte = static_cast<unsigned char>(text[at]);
    // C1 controls are two bytes of UTF-8 that terminals obey too.
    const bool c1 = length == 2 && byte == 0xC2 && static_cast<unsigned char>(text[at + 1]) < 0xA0;
    if (length > 0 && !c1 && byte >= 0x20 && byte != 0x7F) {
      out.append(text, at, length);
      at += length;
      continue;
    }
    char hex[8];
    std::snprintf(hex, sizeof hex, "\\x%02X", byte);
    out += hex;
    ++at;
  }
  return out;
}

void warn(const std::string& line) {
  std::fprintf(stderr, "caryatid-tool: %s\n", printable(line).c_str());
}

}  // namespace caryatid::tool
