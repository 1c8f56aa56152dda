// bridge [--busy|--deny] PORT BUSID PROGRAM ARGS…
//
// Runs PROGRAM with a USB device that a USB/IP server on 127.0.0.1:PORT serves, or with none for the
// BUSID `none`. umockdev stands in
// for sysfs, for /dev/bus/usb and for the kernel's usbfs: libusb works as on a real machine. It
// needs no kernel module and no rights. Run it under `umockdev-wrapper`; PROGRAM must be linked
// dynamically.
//
// A URB of usbfs becomes a transfer of USB/IP, and may stay pending. When the server ends the
// connection the device is unplugged; when it serves it again it is plugged in under a new address.
//
// --busy: another program has claimed the interface. --deny: the node may not be opened, if PROGRAM
// does not run as root.
#include <arpa/inet.h>
#include <errno.h>
#include <glib.h>
#include <linux/usbdevice_fs.h>
#include <netinet/tcp.h>
#include <stdio.h>
#include <string.h>
#include <sys/ioctl.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <unistd.h>

#include "umockdev.h"

enum { SUBMIT = 1, UNLINK, SUBMITTED, UNLINKED, HEADER = 48, RECORD = 312 };

typedef struct {
  guint32 sequence, unlink; // numbers of the transfer and of the request that takes it back
  gulong address;           // of the URB in the program
  UMockdevIoctlData *urb, *buffer;
  gboolean in, control;
  int status, count;
  guint8 *bytes; // from the device
} Transfer;

static GMutex lock;
static GCond finished;
static GQueue flying = G_QUEUE_INIT, done = G_QUEUE_INIT;
static UMockdevTestbed *testbed;
static UMockdevIoctlBase *handler;
static int connection = -1, port;
static const char *bus_id;
static gboolean busy, deny, ending;
static guint32 sequence, address = 1;
static char node[64], sys_path[256];

static gboolean take(int fd, void *to, size_t count) {
  for (guint8 *at = to; count;) {
    ssize_t got = recv(fd, at, count, 0);
    if (got <= 0) {
      if (got < 0 && errno == EINTR) continue;
      return FALSE;
    }
    at += got;
    count -= got;
  }
  return TRUE;
}

static gboolean give(int fd, const void *from, size_t count) {
  for (const guint8 *at = from; count;) {
    ssize_t put = send(fd, at, count, MSG_NOSIGNAL);
    if (put <= 0) {
      if (put < 0 && errno == EINTR) continue;
      return FALSE;
    }
    at += put;
    count -= put;
  }
  return TRUE;
}

// Sends a header with the data of a transfer to the device.
static gboolean request(int fd, guint32 command, guint32 number, gboolean in, guint32 endpoint,
                        guint32 first, guint32 second, const guint8 *setup, const guint8 *data) {
  guint32 words[12] = {htonl(command), htonl(number), htonl(0x10001), htonl(in),
                       htonl(endpoint), htonl(first), htonl(second), 0, htonl(~0u), 0};
  if (setup) memcpy(words + 10, setup, 8);
  guint8 bytes[HEADER + 65536];
  guint32 more = command == SUBMIT && !in ? second : 0;
  if (more > 65536) return FALSE;
  memcpy(bytes, words, HEADER);
  if (more) memcpy(bytes + HEADER, data, more);
  return give(fd, bytes, HEADER + more);
}

static void release(Transfer *transfer) {
  if (transfer->buffer) umockdev_ioctl_data_unref(transfer->buffer);
  umockdev_ioctl_data_unref(transfer->urb);
  g_free(transfer->bytes);
  g_free(transfer);
}

static void finish(Transfer *transfer, int status, int count) {
  transfer->status = status;
  transfer->count = count;
  g_queue_remove(&flying, transfer);
  g_queue_push_tail(&done, transfer);
  g_cond_broadcast(&finished);
}

static Transfer *find(guint32 number, gboolean by_unlink) {
  for (GList *at = flying.head; at; at = at->next) {
    Transfer *transfer = at->data;
    if ((by_unlink ? transfer->unlink : transfer->sequence) == number) return transfer;
  }
  return NULL;
}

static gboolean submit(UMockdevIoctlClient *client, UMockdevIoctlData *argument) {
  Transfer *transfer = g_new0(Transfer, 1);
  transfer->urb = umockdev_ioctl_data_resolve(argument, 0, sizeof(struct usbdevfs_urb), NULL);
  struct usbdevfs_urb *urb = (void *)transfer->urb->data;
  transfer->address = transfer->urb->client_addr;
  transfer->buffer = urb->buffer_length == 0 ? NULL
                     : umockdev_ioctl_data_resolve(
                           transfer->urb, G_STRUCT_OFFSET(struct usbdevfs_urb, buffer),
                           urb->buffer_length, NULL);
  guint8 *bytes = transfer->buffer ? transfer->buffer->data : NULL, none[1] = {0};
  transfer->control = urb->type == USBDEVFS_URB_TYPE_CONTROL;
  transfer->in = ((transfer->control ? bytes[0] : urb->endpoint) & 0x80) != 0;
  transfer->sequence = ++sequence;
  int skip = transfer->control ? 8 : 0;
  if (transfer->buffer) umockdev_ioctl_data_ref(transfer->buffer);
  g_queue_push_tail(&flying, transfer);
  // What cannot be sent is finished by the thread that reads.
  request(connection, SUBMIT, transfer->sequence, transfer->in, urb->endpoint & 0xf, 0,
          urb->buffer_length - skip, skip ? bytes : NULL, bytes ? bytes + skip : none);
  umockdev_ioctl_client_complete(client, 0, 0);
  return TRUE;
}

static gboolean reap(UMockdevIoctlClient *client, UMockdevIoctlData *argument, gboolean present) {
  // The node always looks ready: without a pause libusb would ask without end.
  if (present && g_queue_is_empty(&done))
    g_cond_wait_until(&finished, &lock, g_get_monotonic_time() + 200);
  Transfer *transfer = g_queue_pop_head(&done);
  if (!transfer) {
    umockdev_ioctl_client_complete(client, -1, present ? EAGAIN : ENODEV);
    return TRUE;
  }
  struct usbdevfs_urb *urb = (void *)transfer->urb->data;
  urb->status = transfer->status;
  urb->actual_length = transfer->count;
  if (transfer->bytes)
    memcpy(transfer->buffer->data + (transfer->control ? 8 : 0), transfer->bytes, transfer->count);
  g_autoptr(UMockdevIoctlData) pointer =
      umockdev_ioctl_data_resolve(argument, 0, sizeof(gpointer), NULL);
  umockdev_ioctl_data_set_ptr(pointer, 0, transfer->urb);
  umockdev_ioctl_client_complete(client, 0, 0);
  release(transfer);
  return TRUE;
}

static gboolean on_ioctl(UMockdevIoctlBase *base, UMockdevIoctlClient *client, gpointer data) {
  (void)base, (void)data;
  UMockdevIoctlData *argument = umockdev_ioctl_client_get_arg(client);
  g_mutex_lock(&lock);
  // A handle from before the device was unplugged stays dead.
  gboolean present = connection >= 0 && !strcmp(umockdev_ioctl_client_get_devnode(client), node);
  int result = 0;
  switch (umockdev_ioctl_client_get_request(client)) {
  case USBDEVFS_GET_CAPABILITIES: {
    g_autoptr(UMockdevIoctlData) caps = umockdev_ioctl_data_resolve(argument, 0, 4, NULL);
    *(guint32 *)caps->data = USBDEVFS_CAP_ZERO_PACKET | USBDEVFS_CAP_NO_PACKET_SIZE_LIM |
                             USBDEVFS_CAP_REAP_AFTER_DISCONNECT;
    break;
  }
  case USBDEVFS_SUBMITURB:
    if (present) {
      gboolean handled = submit(client, argument);
      g_mutex_unlock(&lock);
      return handled;
    }
    result = ENODEV;
    break;
  case USBDEVFS_REAPURB:
  case USBDEVFS_REAPURBNDELAY: {
    gboolean handled = reap(client, argument, present);
    g_mutex_unlock(&lock);
    return handled;
  }
  case USBDEVFS_DISCARDURB: {
    gulong wanted = *(gulong *)argument->data;
    result = EINVAL;
    for (GList *at = flying.head; at; at = at->next) {
      Transfer *transfer = at->data;
      if (transfer->address != wanted || transfer->unlink) continue;
      transfer->unlink = ++sequence;
      request(connection, UNLINK, transfer->unlink, FALSE, 0, transfer->sequence, 0, NULL, NULL);
      result = 0;
      break;
    }
    break;
  }
  case USBDEVFS_CLEAR_HALT: {
    g_autoptr(UMockdevIoctlData) endpoint = umockdev_ioctl_data_resolve(argument, 0, 4, NULL);
    guint8 clear[8] = {2, 1, 0, 0, *(guint32 *)endpoint->data & 0xff};
    if (present) request(connection, SUBMIT, ++sequence, FALSE, 0, 0, 0, clear, NULL);
    else result = ENODEV;
    break;
  }
  case USBDEVFS_GETDRIVER:
    result = ENODATA;
    break;
  case USBDEVFS_CLAIMINTERFACE:
  case USBDEVFS_DISCONNECT_CLAIM:
    result = !present ? ENODEV : busy ? EBUSY : 0;
    break;
  case USBDEVFS_RELEASEINTERFACE:
  case USBDEVFS_SETINTERFACE:
  case USBDEVFS_SETCONFIGURATION:
  case USBDEVFS_RESET:
    result = present ? 0 : ENODEV;
    break;
  default:
    g_mutex_unlock(&lock);
    return FALSE;
  }
  umockdev_ioctl_client_complete(client, result ? -1 : 0, result);
  g_mutex_unlock(&lock);
  return TRUE;
}

// A control transfer to the computer, before anybody else talks to the device.
static int ask(int fd, guint8 kind, guint8 *bytes, int most) {
  guint8 setup[8] = {0x80, 6, 0, kind, 0, 0, most & 0xff, most >> 8};
  guint32 words[12];
  if (!request(fd, SUBMIT, ++sequence, TRUE, 0, 0, most, setup, NULL) || !take(fd, words, HEADER))
    return -1;
  int count = ntohl(words[6]);
  return words[5] == 0 && count <= most && take(fd, bytes, count) ? count : -1;
}

// Connects and imports; the socket, or -1.
static int import(void) {
  int fd = socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC, 0), on = 1;
  struct sockaddr_in to = {.sin_family = AF_INET, .sin_port = htons(port)};
  to.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
  guint8 ask_for[40] = {0x01, 0x11, 0x80, 0x03}, reply[8], record[RECORD];
  strncpy((char *)ask_for + 8, bus_id, 31);
  if (fd >= 0 && connect(fd, (void *)&to, sizeof to) == 0 && give(fd, ask_for, sizeof ask_for) &&
      take(fd, reply, 8) && reply[7] == 0 && take(fd, record, RECORD)) {
    setsockopt(fd, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
    return fd;
  }
  if (fd >= 0) close(fd);
  return -1;
}

static gboolean plug_in(void) {
  guint8 bytes[18 + 1024];
  int fd = import();
  if (fd < 0) return FALSE;
  int first = ask(fd, 1, bytes, 18), second = first < 0 ? -1 : ask(fd, 2, bytes + first, 1024);
  if (second < 0) {
    close(fd);
    return FALSE;
  }
  g_autoptr(GString) hex = g_string_new(NULL);
  for (int n = 0; n < first + second; n++) g_string_append_printf(hex, "%02X", bytes[n]);
  address++;
  g_mutex_lock(&lock);
  connection = fd;
  snprintf(node, sizeof node, "/dev/bus/usb/001/%03u", address);
  g_mutex_unlock(&lock);
  g_autoptr(GError) error = NULL;
  umockdev_testbed_attach_ioctl(testbed, node, handler, &error);
  g_assert_no_error(error);
  g_autofree char *text = g_strdup_printf(
      "P: /devices/usb1/1-1\nN: %s\nE: SUBSYSTEM=usb\nE: DRIVER=usb\nE: BUSNUM=001\nE: DEVNUM=%03u\n"
      "E: DEVNAME=%s\nE: DEVTYPE=usb_device\nA: bConfigurationValue=1\\n\nA: busnum=1\\n\n"
      "A: devnum=%u\\n\nA: speed=12\\n\nH: descriptors=%s\n",
      node + 5, address, node, address, hex->str);
  umockdev_testbed_add_from_string(testbed, text, &error);
  g_assert_no_error(error);
  g_autofree char *root = umockdev_testbed_get_root_dir(testbed);
  g_autofree char *file = g_strconcat(root, node, NULL);
  if (deny) {
    // umockdev's own sockets are for everybody, the node is for nobody.
    g_autofree char *socket = g_strconcat(root, "/ioctl", node, NULL);
    chmod(root, 0777);
    chmod(socket, 0777);
    chmod(file, 0);
  }
  snprintf(sys_path, sizeof sys_path, "/sys/devices/usb1/1-1");
  umockdev_testbed_uevent(testbed, sys_path, "add");
  return TRUE;
}

static void plug_out(void) {
  g_mutex_lock(&lock);
  close(connection);
  connection = -1;
  while (!g_queue_is_empty(&flying)) finish(g_queue_peek_head(&flying), -ENODEV, 0);
  g_mutex_unlock(&lock);
  umockdev_testbed_uevent(testbed, sys_path, "remove");
  umockdev_testbed_detach_ioctl(testbed, node, NULL);
  umockdev_testbed_remove_device(testbed, sys_path);
}

// Reads one reply; false at the end of the connection.
static gboolean reply(void) {
  guint32 words[12];
  if (!take(connection, words, HEADER)) return FALSE;
  guint32 command = ntohl(words[0]), number = ntohl(words[1]);
  int status = (int)ntohl(words[5]), count = (int)ntohl(words[6]);
  g_mutex_lock(&lock);
  Transfer *transfer = find(number, command == UNLINKED);
  g_mutex_unlock(&lock);
  guint8 *bytes = NULL;
  if (command == SUBMITTED && transfer && transfer->in && count > 0) {
    bytes = g_malloc(count);
    if (!take(connection, bytes, count)) {
      g_free(bytes);
      return FALSE;
    }
  }
  g_mutex_lock(&lock);
  if (transfer && command == SUBMITTED) {
    transfer->bytes = bytes;
    finish(transfer, status, count);
  } else if (transfer && status != 0) {
    finish(transfer, -ENOENT, 0);
  }
  g_mutex_unlock(&lock);
  return TRUE;
}

static gpointer plug(gpointer data) {
  (void)data;
  while (!ending) {
    if (connection < 0 && !plug_in()) {
      g_usleep(10000);
      continue;
    }
    if (!reply()) plug_out();
  }
  return NULL;
}

int main(int count, char **words) {
  int at = 1;
  for (; at < count && words[at][0] == '-'; at++) {
    busy |= !strcmp(words[at], "--busy");
    deny |= !strcmp(words[at], "--deny");
  }
  if (count - at < 3) {
    fprintf(stderr, "bridge [--busy|--deny] PORT BUSID PROGRAM ARGS…\n");
    return 2;
  }
  port = atoi(words[at]);
  bus_id = words[at + 1];
  testbed = umockdev_testbed_new();
  handler = umockdev_ioctl_base_new();
  g_object_connect(handler, "signal-after::handle-ioctl", on_ioctl, NULL, NULL);
  // The root hub, which every bus has.
  umockdev_testbed_add_from_string(
      testbed, "P: /devices/usb1\nN: bus/usb/001/001\nE: SUBSYSTEM=usb\nE: DEVTYPE=usb_device\n"
               "E: BUSNUM=001\nE: DEVNUM=001\nE: DEVNAME=/dev/bus/usb/001/001\n"
               "A: bConfigurationValue=1\\n\nA: busnum=1\\n\nA: devnum=1\\n\nA: speed=480\\n\n"
               "H: descriptors=12010002090000406B1D020005060302010109021900010100E0000904000001"
               "09000000070581030400FF\n", NULL);
  if (strcmp(bus_id, "none")) {
    for (int tries = 0; !plug_in(); tries++) {
      if (tries == 500) {
        fprintf(stderr, "bridge: nothing serves %s on port %d\n", bus_id, port);
        return 2;
      }
      g_usleep(10000);
    }
    g_thread_new("plug", plug, NULL);
  }
  g_autoptr(GError) error = NULL;
  int status = 0;
  if (!g_spawn_sync(NULL, words + at + 2, NULL, G_SPAWN_SEARCH_PATH | G_SPAWN_CHILD_INHERITS_STDIN,
                    NULL, NULL, NULL, NULL, &status, &error)) {
    fprintf(stderr, "bridge: %s\n", error->message);
    return 2;
  }
  ending = TRUE;
  fflush(NULL);
  // The testbed's folder is removed with it; threads that still read end with the process.
  g_object_unref(testbed);
  _exit(WIFEXITED(status) ? WEXITSTATUS(status) : 1);
}
