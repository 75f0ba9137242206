// A shared library like any other.
extern "C" int atrapos_nothing() { return 1; }
