            /// Checks that the device allows the values of all fields.
            ///
            /// # Errors
            ///
            /// Returns an error if a field has a value that the device does not allow.
            #[allow(clippy::approx_constant)]
            pub fn check(&self) -> Result<(), rt::profinet::NotAllowed> {
                rt::profinet::check("List", self.list, &[(0, 0), (1, 1), (3, 3)])?;
                rt::profinet::check(
                    "List and range",
                    self.list_and_range,
                    &[(200, 200), (0, 100)],
                )?;
                rt::profinet::check("One value", self.one_value, &[(7, 7)])?;
                rt::profinet::check("Float", self.float, &[(-1e38, 1e38)])?;
                rt::profinet::check(
                    "Steps",
                    self.steps,
                    &[(-0.5, -0.5), (0.5, 0.5), (1000.0, 2000.0)],
                )?;
                Ok(())
            }
