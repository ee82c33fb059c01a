#include <cfe_tbl_filedef.h>
#include "cfs/payload.h"

/* The preset of the table: where the flight image is, and the component's application process. */
LASSO_Config_t LASSO_Config = {.image = "/cf/lasso.3dli", .apid = 0x3D1};

CFE_TBL_FILEDEF(LASSO_Config, LASSO.Config, Image and identity of 3DLASSO, lasso_config.tbl)
