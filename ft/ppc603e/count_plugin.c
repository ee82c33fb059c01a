/* QEMU plugin (API version 1, as of QEMU 7.2): counts the instructions that the emulated processor executes between two functions.
 *
 *   qemu-ppc -plugin count_plugin.so,begin=ADDRESS,end=ADDRESS,out=FILE PROGRAM
 *
 * FILE gets a line "call N" for each pass from the entry of the function at `begin` to that at `end`, then a line "block ADDRESS N" for each
 * straight run of instructions, N being those executed in it during all passes. Single-threaded programs only. Calling the two functions
 * is counted with some ten instructions a pass. Debian ships no qemu-plugin.h: what is used of it is declared here. */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef uint64_t qemu_plugin_id_t;
struct qemu_plugin_tb;
enum qemu_plugin_op { QEMU_PLUGIN_INLINE_ADD_U64 };
enum qemu_plugin_cb_flags { QEMU_PLUGIN_CB_NO_REGS };
void qemu_plugin_register_vcpu_tb_trans_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, struct qemu_plugin_tb *));
void qemu_plugin_register_vcpu_tb_exec_inline(struct qemu_plugin_tb *, enum qemu_plugin_op, void *, uint64_t);
void qemu_plugin_register_vcpu_tb_exec_cb(struct qemu_plugin_tb *, void (*)(unsigned, void *), enum qemu_plugin_cb_flags, void *);
void qemu_plugin_register_atexit_cb(qemu_plugin_id_t, void (*)(qemu_plugin_id_t, void *), void *);
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *);
uint64_t qemu_plugin_tb_vaddr(const struct qemu_plugin_tb *);

#define EXPORT __attribute__((visibility("default")))
EXPORT int qemu_plugin_version = 1;

struct block {
  struct block *next;
  uint64_t address;
  uint64_t executed; /* instructions, since the program's start */
  uint64_t at_begin; /* `executed` when the current pass began */
  uint64_t inside;   /* of all passes */
};

static struct block *blocks;
static uint64_t begin_address, end_address;
static FILE *out;

static void begin_pass(unsigned cpu, void *data) {
  (void)cpu, (void)data;
  for (struct block *b = blocks; b; b = b->next) b->at_begin = b->executed;
}

static void end_pass(unsigned cpu, void *data) {
  uint64_t sum = 0;
  (void)cpu, (void)data;
  for (struct block *b = blocks; b; b = b->next) {
    sum += b->executed - b->at_begin;
    b->inside += b->executed - b->at_begin;
  }
  fprintf(out, "call %" PRIu64 "\n", sum);
}

static void translated(qemu_plugin_id_t id, struct qemu_plugin_tb *tb) {
  struct block *b = calloc(1, sizeof *b);
  (void)id;
  if (!b) abort();
  b->next = blocks;
  b->address = qemu_plugin_tb_vaddr(tb);
  blocks = b;
  qemu_plugin_register_vcpu_tb_exec_inline(tb, QEMU_PLUGIN_INLINE_ADD_U64, &b->executed, qemu_plugin_tb_n_insns(tb));
  if (b->address == begin_address) qemu_plugin_register_vcpu_tb_exec_cb(tb, begin_pass, QEMU_PLUGIN_CB_NO_REGS, NULL);
  if (b->address == end_address) qemu_plugin_register_vcpu_tb_exec_cb(tb, end_pass, QEMU_PLUGIN_CB_NO_REGS, NULL);
}

static void finish(qemu_plugin_id_t id, void *data) {
  (void)id, (void)data;
  for (const struct block *b = blocks; b; b = b->next) {
    if (b->inside > 0) fprintf(out, "block %" PRIx64 " %" PRIu64 "\n", b->address, b->inside);
  }
  fclose(out);
}

EXPORT int qemu_plugin_install(qemu_plugin_id_t id, const void *info, int argc, char **argv) {
  (void)info;
  for (int i = 0; i < argc; ++i) {
    if (strncmp(argv[i], "begin=", 6) == 0) begin_address = strtoull(argv[i] + 6, NULL, 16);
    if (strncmp(argv[i], "end=", 4) == 0) end_address = strtoull(argv[i] + 4, NULL, 16);
    if (strncmp(argv[i], "out=", 4) == 0) out = fopen(argv[i] + 4, "w");
  }
  if (!begin_address || !end_address || !out) {
    fprintf(stderr, "count_plugin: begin=ADDRESS,end=ADDRESS,out=FILE are needed\n");
    return 1;
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
  qemu_plugin_register_atexit_cb(id, finish, NULL);
  return 0;
}
