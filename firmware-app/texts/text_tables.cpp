#include "firmware-app/texts/text_tables.h"

#define TOML_EXCEPTIONS 0
#include <toml++/toml.h>

namespace caryatid::app {
namespace {

class Loader {
 public:
  Loader(const std::string& source, TextTable* table, Messages* messages)
      : table_(table), messages_(messages) {
    for (std::size_t at = 0; at <= source.size();) {
      const std::size_t end = source.find('\n', at);
      lines_.push_back(source.substr(at, end == std::string::npos ? end : end - at));
      if (end == std::string::npos) break;
      at = end + 1;
    }
  }

  void read(const toml::table& root) {
    for (const auto& [key, node] : root) {
      const std::string name(key.str());
      if (name == "name")
        take(node, &table_->name);
      else if (name == "voice")
        take(node, &table_->voice);
      else if (name == "closed")
        take(node, &table_->closed);
      else if (name == "open")
        take(node, &table_->open);
      else if (name == "weekdays")
        take_names(node, 7, &table_->weekdays);
      else if (name == "months")
        take_names(node, 12, &table_->months);
      else
        flatten(name, node);
    }
  }

 private:
  void wrong(const toml::node& node, const std::string& what) {
    messages_->wrong(table_->file, node.source().begin.line, what);
  }
  void take(const toml::node& node, std::string* out) {
    if (const auto* text = node.as_string())
      *out = text->get();
    else
      wrong(node, "not a text; put it in quotation marks");
  }
  void take_names(const toml::node& node, std::size_t count, std::vector<std::string>* out) {
    const toml::array* array = node.as_array();
    std::vector<std::string> names;
    if (array != nullptr)
      for (const toml::node& n : *array)
        if (n.is_string()) names.push_back(n.as_string()->get());
    if (names.size() == count)
      *out = names;
    else
      wrong(node, "not " + std::to_string(count) + " names; list them all");
  }
  void flatten(const std::string& name, const toml::node& node) {
    if (const toml::table* table = node.as_table()) {
      for (const auto& [key, child] : *table) flatten(name + "." + std::string(key.str()), child);
    } else if (const auto* text = node.as_string()) {
      table_->texts[name] = {text->get(), first_line(node)};
    } else {
      wrong(node, "'" + name + "' is neither a text nor a table; put it in quotation marks");
    }
  }
  // Where a text of several lines begins: behind its three quotation marks, or on the next line.
  std::size_t first_line(const toml::node& node) const {
    const std::size_t line = node.source().begin.line, column = node.source().begin.column;
    if (line == 0 || line > lines_.size()) return line;
    const std::string& text = lines_[line - 1];
    const std::size_t at = text.find("\"\"\"", column > 0 ? column - 1 : 0);
    const std::size_t raw = text.find("'''", column > 0 ? column - 1 : 0);
    const std::size_t marks = std::min(at, raw);
    return marks != std::string::npos && text.find_first_not_of(" \r", marks + 3) == text.npos
               ? line + 1
               : line;
  }

  TextTable* table_;
  Messages* messages_;
  std::vector<std::string> lines_;
};

}  // namespace

TextTable load_texts(const std::string& code, bool needed, ProgrammeFiles& files,
                     Messages* messages) {
  TextTable table;
  table.code = code;
  table.voice = code;
  table.name = code;
  table.file = files.full_name("texts/" + code + ".toml");
  const std::string name = "texts/" + code + ".toml";
  if (!needed && !files.exists(name)) return table;
  std::string source, error;
  if (!files.read(name, kMostTextFileBytes, &source, &error)) {
    messages->wrong(table.file, 0, error + " (another language stands in)");
    return table;
  }
  if (const std::size_t line = mend_utf8(&source); line != 0)
    messages->wrong(table.file, line, "not UTF-8; save the file as UTF-8 (the letter is replaced)");
  const toml::parse_result result = toml::parse(source, table.file);
  if (!result) {
    messages->wrong(
        table.file, result.error().source().begin.line,
        std::string(result.error().description()) + "; mend the line (another language stands in)");
    return table;
  }
  Loader(source, &table, messages).read(result.table());
  table.loaded = true;
  return table;
}

}  // namespace caryatid::app
