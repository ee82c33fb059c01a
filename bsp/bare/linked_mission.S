/* The mission's image, where a loader would put it (sections.ld). */
.section .mission_image, "a"
.incbin LASSO_MISSION_IMAGE
.section .note.GNU-stack, ""
