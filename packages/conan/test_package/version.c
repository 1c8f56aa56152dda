/* Whether the library that is linked has the version of the package. */
#include "asperity.h"

#include <stdio.h>
#include <string.h>

int main(int argc, char **argv) {
  printf("asperity %s\n", asperity_version());
  return argc == 2 && strcmp(argv[1], asperity_version()) == 0 ? 0 : 1;
}
