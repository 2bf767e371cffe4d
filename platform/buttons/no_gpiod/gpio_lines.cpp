// The build found no libgpiod: GPIO buttons cannot be opened, and the error says why.
#include "platform/buttons/gpio.h"

namespace caryatid::platform {
namespace {

class NoGpioLines final : public GpioLines {
 public:
  Status open(std::span<const GpioLine>, ErrorLine& out_error) override {
    return gpio_error(GpioFault::not_built, "GPIO", 0, out_error);
  }
  void close() override {}
  Result<std::size_t> read(std::int64_t, std::span<GpioEdge>) override { return {}; }
};

}  // namespace

std::unique_ptr<GpioLines> make_gpio_lines() { return std::make_unique<NoGpioLines>(); }

}  // namespace caryatid::platform
