#include <pia/pia.h>
#include <stdio.h>

int main(void)
{
    pia_context *context;
    if (pia_context_create(NULL, &context) != PIA_OK) return 1;
    printf("pia %s\n", pia_version());
    pia_context_destroy(context);
    return 0;
}
