/* QEMU TCG plugin, API version 1 (QEMU 4.2 to 8.2): how many instructions the guest
 * executed between the first instruction of one symbol and the first of another.
 *
 *   -plugin libtickcount.so,begin=SYMBOL,end=SYMBOL,out=FILE
 *
 * One decimal number a line, one line a pair. A begin without its end, or an end without
 * its begin, writes "unpaired". The few declarations that are needed stand here because
 * distributions do not install the header. */
#include <inttypes.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define EXPORT __attribute__((visibility("default")))

struct qemu_plugin_tb;
struct qemu_plugin_insn;
enum { CB_NO_REGS = 0, INLINE_ADD_U64 = 0 };
size_t qemu_plugin_tb_n_insns(const struct qemu_plugin_tb *block);
struct qemu_plugin_insn *qemu_plugin_tb_get_insn(const struct qemu_plugin_tb *block, size_t index);
const char *qemu_plugin_insn_symbol(const struct qemu_plugin_insn *instruction);
uint64_t qemu_plugin_insn_vaddr(const struct qemu_plugin_insn *instruction);
void qemu_plugin_register_vcpu_tb_trans_cb(uint64_t id, void (*f)(uint64_t, struct qemu_plugin_tb *));
void qemu_plugin_register_vcpu_insn_exec_cb(struct qemu_plugin_insn *instruction,
                                            void (*f)(unsigned, void *), int flags, void *data);
void qemu_plugin_register_vcpu_insn_exec_inline(struct qemu_plugin_insn *instruction, int operation,
                                                void *counter, uint64_t amount);
void qemu_plugin_register_atexit_cb(uint64_t id, void (*f)(uint64_t, void *), void *data);

/* A symbol and the address of its first instruction, once that was seen. */
struct marker {
  char *symbol;
  uint64_t address;
  bool seen;
};

static struct marker begin_marker, end_marker;
static FILE *out;
static uint64_t executed, begun_at;
static bool under_way;

static void begin(unsigned cpu, void *data) {
  (void)cpu;
  (void)data;
  if (under_way) fputs("unpaired\n", out);
  under_way = true;
  begun_at = executed;
}

static void end(unsigned cpu, void *data) {
  (void)cpu;
  (void)data;
  if (under_way) fprintf(out, "%" PRIu64 "\n", executed - begun_at);
  else fputs("unpaired\n", out);
  under_way = false;
}

/* Code is translated in the order in which it is first executed, and a function is entered
 * at its first instruction: the first address seen with a symbol is that of the symbol. */
static bool is_at(struct marker *marker, const char *symbol, uint64_t address) {
  if (symbol == NULL || strcmp(symbol, marker->symbol) != 0) return false;
  if (!marker->seen) {
    marker->seen = true;
    marker->address = address;
  }
  return marker->address == address;
}

static void translated(uint64_t id, struct qemu_plugin_tb *block) {
  (void)id;
  size_t count = qemu_plugin_tb_n_insns(block);
  for (size_t i = 0; i < count; i++) {
    struct qemu_plugin_insn *instruction = qemu_plugin_tb_get_insn(block, i);
    const char *symbol = qemu_plugin_insn_symbol(instruction);
    uint64_t address = qemu_plugin_insn_vaddr(instruction);
    qemu_plugin_register_vcpu_insn_exec_inline(instruction, INLINE_ADD_U64, &executed, 1);
    if (is_at(&begin_marker, symbol, address))
      qemu_plugin_register_vcpu_insn_exec_cb(instruction, begin, CB_NO_REGS, NULL);
    if (is_at(&end_marker, symbol, address))
      qemu_plugin_register_vcpu_insn_exec_cb(instruction, end, CB_NO_REGS, NULL);
  }
}

static void finished(uint64_t id, void *data) {
  (void)id;
  (void)data;
  if (under_way) fputs("unpaired\n", out);
  fclose(out);
}

EXPORT int qemu_plugin_version = 1;

EXPORT int qemu_plugin_install(uint64_t id, const void *info, int argc, char **argv) {
  (void)info;
  for (int i = 0; i < argc; i++) {
    if (strncmp(argv[i], "begin=", 6) == 0) begin_marker.symbol = strdup(argv[i] + 6);
    else if (strncmp(argv[i], "end=", 4) == 0) end_marker.symbol = strdup(argv[i] + 4);
    else if (strncmp(argv[i], "out=", 4) == 0) out = fopen(argv[i] + 4, "w");
    else return -1;
  }
  if (begin_marker.symbol == NULL || end_marker.symbol == NULL || out == NULL) {
    fputs("tickcount: begin=, end= and a writable out= are needed\n", stderr);
    return -1;
  }
  qemu_plugin_register_vcpu_tb_trans_cb(id, translated);
  qemu_plugin_register_atexit_cb(id, finished, NULL);
  return 0;
}
