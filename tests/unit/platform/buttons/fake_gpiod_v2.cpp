#include <gpiod.h>

#include <cerrno>

#include "tests/unit/platform/buttons/fake_gpio.h"

using caryatid::platform::testing::FakeChip;
using caryatid::platform::testing::FakeEvent;
using caryatid::platform::testing::FakeLine;
using caryatid::platform::testing::world;

// The handles that libgpiod 2 keeps opaque.
struct gpiod_chip {
  FakeChip* chip;
};
struct gpiod_chip_info {
  FakeChip* chip;
};
struct gpiod_line_settings {
  bool input = false, both_edges = false, active_low = false;
  int bias = 0;
  unsigned long debounce_us = 0;
};
struct gpiod_line_config {
  unsigned offset = 0;
  gpiod_line_settings settings;
};
struct gpiod_request_config {};
struct gpiod_line_request {
  FakeLine* line;
};
struct gpiod_edge_event {
  FakeEvent event;
};
struct gpiod_edge_event_buffer {
  std::vector<gpiod_edge_event> events;
};

extern "C" {

bool gpiod_is_gpiochip_device(const char* path) { return world.chip_at(path) != nullptr; }

gpiod_chip* gpiod_chip_open(const char* path) {
  FakeChip* const chip = world.chip_at(path);
  errno = chip == nullptr ? ENOENT : chip->open_errno;
  if (errno != 0) return nullptr;
  ++chip->open_count;
  return new gpiod_chip{chip};
}

void gpiod_chip_close(gpiod_chip* chip) {
  --chip->chip->open_count;
  delete chip;
}

gpiod_chip_info* gpiod_chip_get_info(gpiod_chip* chip) { return new gpiod_chip_info{chip->chip}; }
void gpiod_chip_info_free(gpiod_chip_info* info) { delete info; }
const char* gpiod_chip_info_get_name(gpiod_chip_info* info) { return info->chip->name.c_str(); }
const char* gpiod_chip_info_get_label(gpiod_chip_info* info) { return info->chip->label.c_str(); }

int gpiod_chip_get_line_offset_from_name(gpiod_chip* chip, const char* name) {
  for (std::size_t i = 0; i < chip->chip->lines.size(); ++i)
    if (chip->chip->lines[i].name == name) return static_cast<int>(i);
  errno = ENOENT;
  return -1;
}

gpiod_line_settings* gpiod_line_settings_new(void) { return new gpiod_line_settings; }
void gpiod_line_settings_free(gpiod_line_settings* settings) { delete settings; }
int gpiod_line_settings_set_direction(gpiod_line_settings* s, gpiod_line_direction direction) {
  s->input = direction == GPIOD_LINE_DIRECTION_INPUT;
  return 0;
}
int gpiod_line_settings_set_edge_detection(gpiod_line_settings* s, gpiod_line_edge edge) {
  s->both_edges = edge == GPIOD_LINE_EDGE_BOTH;
  return 0;
}
int gpiod_line_settings_set_bias(gpiod_line_settings* s, gpiod_line_bias bias) {
  s->bias = bias == GPIOD_LINE_BIAS_DISABLED    ? -1
            : bias == GPIOD_LINE_BIAS_PULL_UP   ? 1
            : bias == GPIOD_LINE_BIAS_PULL_DOWN ? 2
                                                : 0;
  return 0;
}
void gpiod_line_settings_set_active_low(gpiod_line_settings* s, bool low) { s->active_low = low; }
void gpiod_line_settings_set_debounce_period_us(gpiod_line_settings* s, unsigned long period_us) {
  s->debounce_us = period_us;
}
int gpiod_line_settings_set_event_clock(gpiod_line_settings*, gpiod_line_clock clock) {
  return clock == GPIOD_LINE_CLOCK_MONOTONIC ? 0 : -1;
}

gpiod_line_config* gpiod_line_config_new(void) { return new gpiod_line_config; }
void gpiod_line_config_free(gpiod_line_config* config) { delete config; }
int gpiod_line_config_add_line_settings(gpiod_line_config* config, const unsigned int* offsets,
                                        size_t, gpiod_line_settings* settings) {
  config->offset = offsets[0];
  config->settings = *settings;
  return 0;
}

gpiod_request_config* gpiod_request_config_new(void) { return new gpiod_request_config; }
void gpiod_request_config_free(gpiod_request_config* config) { delete config; }
void gpiod_request_config_set_consumer(gpiod_request_config*, const char*) {}
void gpiod_request_config_set_event_buffer_size(gpiod_request_config*, size_t) {}

gpiod_line_request* gpiod_chip_request_lines(gpiod_chip* chip, gpiod_request_config*,
                                             gpiod_line_config* config) {
  const gpiod_line_settings& settings = config->settings;
  if (config->offset >= chip->chip->lines.size() || !settings.input || !settings.both_edges) {
    errno = EINVAL;
    return nullptr;
  }
  FakeLine& line = chip->chip->lines[config->offset];
  if (line.request_errno != 0) {
    errno = line.request_errno;
    return nullptr;
  }
  line.open_pipe();
  line.active_low = settings.active_low;
  line.bias = settings.bias;
  line.debounce_us = settings.debounce_us;
  return new gpiod_line_request{&line};
}

void gpiod_line_request_release(gpiod_line_request* request) {
  request->line->close_pipe();
  delete request;
}

int gpiod_line_request_get_fd(gpiod_line_request* request) { return request->line->read_end; }

gpiod_line_value gpiod_line_request_get_value(gpiod_line_request* request, unsigned int) {
  return static_cast<gpiod_line_value>(request->line->level);
}

gpiod_edge_event_buffer* gpiod_edge_event_buffer_new(size_t capacity) {
  auto* buffer = new gpiod_edge_event_buffer;
  buffer->events.reserve(capacity);
  return buffer;
}
void gpiod_edge_event_buffer_free(gpiod_edge_event_buffer* buffer) { delete buffer; }

int gpiod_line_request_read_edge_events(gpiod_line_request* request,
                                        gpiod_edge_event_buffer* buffer, size_t most) {
  if (request->line->read_errno != 0) {
    errno = request->line->read_errno;
    return -1;
  }
  buffer->events.clear();
  for (FakeEvent event;
       buffer->events.size() < most &&
       ::read(request->line->read_end, &event, sizeof event) == static_cast<ssize_t>(sizeof event);)
    buffer->events.push_back({event});
  return static_cast<int>(buffer->events.size());
}

gpiod_edge_event* gpiod_edge_event_buffer_get_event(gpiod_edge_event_buffer* buffer,
                                                    unsigned long index) {
  return &buffer->events[index];
}
unsigned long gpiod_edge_event_get_line_seqno(gpiod_edge_event* event) {
  return event->event.seqno;
}
gpiod_edge_event_type gpiod_edge_event_get_event_type(gpiod_edge_event* event) {
  return event->event.rising ? GPIOD_EDGE_EVENT_RISING_EDGE : GPIOD_EDGE_EVENT_FALLING_EDGE;
}
uint64_t gpiod_edge_event_get_timestamp_ns(gpiod_edge_event* event) { return event->event.time_ns; }

}  // extern "C"
