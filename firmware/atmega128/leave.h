/* leave.h: from the program into the boot loader (flash_map.h). */
#ifndef LEAVE_H
#define LEAVE_H

/* Switches off the motors and all else that the program uses, and enters the loader. Returns, with
 * nothing done, only where there is no loader. */
void leave_for_loader(void);

#endif
