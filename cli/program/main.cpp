#include "program/program.hpp"

int main(int argc, char** argv) {
  return itin::cli::run(argc, argv);
}
