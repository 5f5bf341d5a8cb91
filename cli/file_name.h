/* Names of files: what they say of the format, and which outputs can be refused before any work is done. */
#ifndef PIA_CLI_FILE_NAME_H
#define PIA_CLI_FILE_NAME_H

#include "session.h"

/* Refuses a file that could not be written: its folder is missing or closed, or it is a folder itself. */
int output_check(const char *path);
/* The extension without its dot, "" when there is none. */
const char *extension_of(const char *path);
/* 1: pia_plot draws it, by `format` or by the extension when format is NULL. */
int is_picture(const char *path, const char *format);
/* 1: pia_page_write writes it. */
int is_page(const char *path, const char *format);
/* 1: of a format that holds nothing but models, by `format` or by the extension when format is NULL. */
int is_model_name(const char *path, const char *format);
/* The format asked for; for a file with no extension, such as a standard stream or a device, `otherwise`; NULL: the extension tells. */
const char *format_of(const char *path, const char *format, const char *otherwise);
/* "model.json" and "1e-3" give "model.1e-3.json", kept by the session. */
const char *output_at_level(struct session *session, const char *path, const char *level);

#endif
