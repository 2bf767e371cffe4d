// --check: what the kiosk would refuse at its start, all of it, without starting.
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <utility>

#include "firmware-app/kiosk.h"
#include "platform/log/log.h"

namespace caryatid::app {

using platform::Event;

// Where the arena goes, a line a section.
void Kiosk::print_memory() {
  std::puts("memory that the agent takes at start and keeps:");
  std::size_t sum = 0;
  const auto line = [&sum](const char* what, std::size_t bytes) {
    std::printf("  %-16s %10zu bytes\n", what, bytes);
    sum += bytes;
  };
  const pack::View& v = person_.view();
  line("textures", v.texels.size_bytes());
  line("vertices", v.versions.size_bytes());
  line("base triangles", v.base_indices.size_bytes());
  line("splits", v.splits.size_bytes() + v.split_data.size_bytes());
  line("face tables",
       v.fat_first.size_bytes() + v.fat_moves.size_bytes() + v.channels.size_bytes());
  const std::size_t image = pack_file_.header().image_bytes;
  line("the rest", image - sum);
  line("live meshes", memory_.arena().used_bytes() - image);
  line("two programmes", Desk::kArenaBytes);
  std::printf("  %-16s %10zu bytes of the arena, file %u bytes\n", "sum", sum,
              pack_file_.header().file_bytes);
}

// The whole pack, split by split.
bool Kiosk::check_pack(std::string* out_error) {
  if (!pack_file_.open(options_.pack, out_error) || !load_base(out_error)) return false;
  Status status;
  while (status.ok() && !pack_file_.exhausted() && !loader_.complete()) {
    status = pack_file_.feed(1 << 20, &loader_);
    if (status.ok() && !person_.refine(loader_).ok())
      status = {Code::corrupt_data, std::uint16_t(pack::Refusal::bad_split_order)};
  }
  if (!status.ok()) *out_error = describe_refusal(options_.pack.c_str(), status);
  return status.ok();
}

bool Kiosk::check(const Options& options) {
  Kiosk kiosk(options);
  bool ok = true;
  const auto tell = [&ok](Event event, bool sound, const std::string& error) {
    if (!sound && !error.empty()) platform::log(event, "%s", error.c_str());
    ok = ok && sound;
  };
  std::string error;
  const bool configured = kiosk.load_config(&error);
  tell(Event::config_refused, configured, error);
  if (configured) tell(Event::config_refused, Desk::check(options.config), "");
  tell(Event::config_refused, kiosk.read_script(), "");
  const bool packed = options.pack.empty() || kiosk.check_pack(&error);
  tell(Event::pack_refused, packed, error);
  if (!options.play.empty())
    tell(Event::file_refused, kiosk.player_.open(options.play, &error), error);
  const std::pair<const char*, const std::string*> there[] = {{"voice", &options.voice},
                                                              {"recordings", &options.recordings}};
  for (const auto& [name, path] : there)
    if (!path->empty() && ::access(path->c_str(), name[0] == 'v' ? X_OK : R_OK) != 0)
      tell(Event::file_refused, false,
           std::string("--") + name + " " + *path + ": " + std::strerror(errno));
  if (ok)
    std::puts(options.pack.empty() ? "caryatid: the configuration is sound"
                                   : "caryatid: configuration and pack are sound");
  if (ok && !options.pack.empty()) kiosk.print_memory();
  return ok;
}

}  // namespace caryatid::app
