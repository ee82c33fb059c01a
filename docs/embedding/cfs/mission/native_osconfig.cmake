# On Linux without privileges: queues as deep, and tasks as urgent, as the system allows.
set(OSAL_CONFIG_DEBUG_PERMISSIVE_MODE TRUE)
