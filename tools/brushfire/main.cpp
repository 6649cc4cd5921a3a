#include <brushfire/brushfire.h>
int main() { return 0; }
