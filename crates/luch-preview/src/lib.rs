//! A quick look: z-buffer and wireframe, without light transport.
