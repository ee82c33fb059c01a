#include <cfe_sb_api_typedefs.h>
#include <cfe_tbl_filedef.h>
#include <to_lab_tbl.h>

#include "cfs/message.h"

/* What goes to the ground: the component's packets, poses and housekeeping of the app, events. */
TO_LAB_Subs_t TO_LAB_Subs = {.Subs = {{CFE_SB_MSGID_WRAP_VALUE(LASSO_TELEMETRY_MID(0x3D1)), {0, 0}, 10},
                                      {CFE_SB_MSGID_WRAP_VALUE(LASSO_POSE_MID), {0, 0}, 10},
                                      {CFE_SB_MSGID_WRAP_VALUE(LASSO_HK_MID), {0, 0}, 10},
                                      {CFE_SB_MSGID_RESERVED, {0, 0}, 0}}};

CFE_TBL_FILEDEF(TO_LAB_Subs, TO_LAB.TO_LAB_Subs, Telemetry of 3DLASSO, to_lab_sub.tbl)
