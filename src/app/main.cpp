#include "app/program.hpp"

int main(int argc, char** argv) {
  return gnomon::app::program(argc, argv);
}
