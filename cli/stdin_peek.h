/* Standard input that may be models or points: its first byte tells. */
#ifndef PIA_CLI_STDIN_PEEK_H
#define PIA_CLI_STDIN_PEEK_H

/* Puts standard input into memory, so that it can be looked at and then read from its beginning. Returns its first byte that is no
 * blank, 0 when it is empty, -1 when it cannot be read. */
int stdin_peek(void);

#endif
