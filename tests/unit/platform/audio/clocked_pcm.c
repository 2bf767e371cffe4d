/* A sound card for tests as a plugin of the real libasound: plays at its rate by the monotonic
 * clock, writes what it plays to a file, and goes wrong at a frame that its configuration names.
 *   pcm.x { type caryatid_clock file "played.raw" channels 2 xrun_at 9 dead_at 9 gone_at 9 } */
#define PIC 1 /* Without it the header registers a static plugin. */
#include <alsa/asoundlib.h>
#include <alsa/pcm_external.h>
#include <alsa/pcm_ioplug.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/timerfd.h>
#include <time.h>
#include <unistd.h>

typedef struct {
  snd_pcm_ioplug_t io;
  FILE* file;
  int64_t start_us;
  snd_pcm_sframes_t before;       /* Frames of earlier starts. */
  long xrun_at, dead_at, gone_at; /* One xrun; nothing but xruns; unplugged. */
  long written;
} card_t;

static int64_t now_us(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (int64_t)t.tv_sec * 1000000 + t.tv_nsec / 1000;
}

static int card_start(snd_pcm_ioplug_t* io) {
  card_t* card = io->private_data;
  const struct itimerspec every = {{0, 2000000}, {0, 2000000}};
  timerfd_settime(io->poll_fd, 0, &every, NULL);
  card->start_us = now_us();
  return 0;
}

static int card_stop(snd_pcm_ioplug_t* io) {
  card_t* card = io->private_data;
  card->start_us = -1;
  return 0;
}

static snd_pcm_sframes_t card_pointer(snd_pcm_ioplug_t* io) {
  card_t* card = io->private_data;
  if (card->start_us < 0) return 0;
  const int64_t played = (now_us() - card->start_us) * io->rate / 1000000;
  if (card->dead_at > 0 && card->before + played >= card->dead_at) return -EPIPE;
  if (card->xrun_at > 0 && card->before + played >= card->xrun_at) {
    card->xrun_at = 0;
    card->before += played;
    return -EPIPE;
  }
  return (snd_pcm_sframes_t)(played % (int64_t)io->buffer_size);
}

static snd_pcm_sframes_t card_transfer(snd_pcm_ioplug_t* io, const snd_pcm_channel_area_t* areas,
                                       snd_pcm_uframes_t offset, snd_pcm_uframes_t size) {
  card_t* card = io->private_data;
  if (card->gone_at > 0 && card->written >= card->gone_at) return -ENODEV;
  card->written += (long)size;
  const char* from = (const char*)areas->addr + (areas->first + areas->step * offset) / 8;
  fwrite(from, 2 * io->channels, size, card->file);
  fflush(card->file);
  return (snd_pcm_sframes_t)size;
}

static int card_revents(snd_pcm_ioplug_t* io, struct pollfd* fds, unsigned int count,
                        unsigned short* revents) {
  uint64_t ticks;
  (void)count;
  *revents = 0;
  if ((fds[0].revents & POLLIN) && read(io->poll_fd, &ticks, sizeof ticks) > 0) *revents = POLLOUT;
  return 0;
}

static int card_close(snd_pcm_ioplug_t* io) {
  card_t* card = io->private_data;
  fclose(card->file);
  close(io->poll_fd);
  free(card);
  return 0;
}

static const snd_pcm_ioplug_callback_t callbacks = {
    .start = card_start,
    .stop = card_stop,
    .pointer = card_pointer,
    .transfer = card_transfer,
    .close = card_close,
    .poll_revents = card_revents,
};

static int constrain(card_t* card, unsigned channels) {
  const unsigned access[] = {SND_PCM_ACCESS_RW_INTERLEAVED, SND_PCM_ACCESS_MMAP_INTERLEAVED};
  const unsigned format = SND_PCM_FORMAT_S16;
  int e = snd_pcm_ioplug_set_param_list(&card->io, SND_PCM_IOPLUG_HW_ACCESS, 2, access);
  if (e >= 0) e = snd_pcm_ioplug_set_param_list(&card->io, SND_PCM_IOPLUG_HW_FORMAT, 1, &format);
  if (e >= 0)
    e = snd_pcm_ioplug_set_param_list(&card->io, SND_PCM_IOPLUG_HW_CHANNELS, 1, &channels);
  if (e >= 0)
    e = snd_pcm_ioplug_set_param_minmax(&card->io, SND_PCM_IOPLUG_HW_PERIOD_BYTES, 128, 8192);
  if (e >= 0)
    e = snd_pcm_ioplug_set_param_minmax(&card->io, SND_PCM_IOPLUG_HW_BUFFER_BYTES, 512, 32768);
  return e;
}

SND_PCM_PLUGIN_DEFINE_FUNC(caryatid_clock) {
  snd_config_iterator_t i, next;
  const char* path = "/dev/null";
  long channels = 1, xrun_at = 0, dead_at = 0, gone_at = 0;
  (void)root;
  snd_config_for_each(i, next, conf) {
    snd_config_t* n = snd_config_iterator_entry(i);
    const char* id;
    if (snd_config_get_id(n, &id) < 0) continue;
    if (strcmp(id, "file") == 0) snd_config_get_string(n, &path);
    if (strcmp(id, "channels") == 0) snd_config_get_integer(n, &channels);
    if (strcmp(id, "xrun_at") == 0) snd_config_get_integer(n, &xrun_at);
    if (strcmp(id, "dead_at") == 0) snd_config_get_integer(n, &dead_at);
    if (strcmp(id, "gone_at") == 0) snd_config_get_integer(n, &gone_at);
  }
  card_t* card = calloc(1, sizeof *card);
  if (card == NULL) return -ENOMEM;
  card->file = fopen(path, "ab");
  if (card->file == NULL) {
    free(card);
    return -errno;
  }
  card->start_us = -1;
  card->xrun_at = xrun_at;
  card->dead_at = dead_at;
  card->gone_at = gone_at;
  card->io.version = SND_PCM_IOPLUG_VERSION;
  card->io.name = "clocked card of the tests";
  card->io.poll_fd = timerfd_create(CLOCK_MONOTONIC, TFD_NONBLOCK | TFD_CLOEXEC);
  card->io.poll_events = POLLIN;
  card->io.callback = &callbacks;
  card->io.private_data = card;
  int error = snd_pcm_ioplug_create(&card->io, name, stream, mode);
  if (error >= 0) error = constrain(card, (unsigned)channels);
  if (error < 0) return error;
  *pcmp = card->io.pcm;
  return 0;
}
SND_PCM_PLUGIN_SYMBOL(caryatid_clock);
