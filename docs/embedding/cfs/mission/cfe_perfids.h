/* As in the sample mission of cFS. */
#include <sample_defs/cfe_perfids.h>
