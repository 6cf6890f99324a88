<?xml version="1.0" encoding="utf-8"?>
<ISO15745ProfileContainer xmlns="http://www.canopen.org/xml/1.0" xmlns:xsi="http://www.w3.org/2001/XMLSchema-instance">
  <ISO15745Profile>
    <ProfileBody xsi:type="ProfileBody_Device_CANopen" fileName="pump.xdc">
      <DeviceIdentity>
        <vendorName>Maker</vendorName>
        <vendorID>0x00000001</vendorID>
        <productName>Pump</productName>
      </DeviceIdentity>
    </ProfileBody>
  </ISO15745Profile>
  <ISO15745Profile>
    <ProfileBody xsi:type="ProfileBody_CommunicationNetwork_CANopen" fileName="pump.xdc">
      <ApplicationLayers>
        <CANopenObjectList>
          <CANopenObject index="1000" name="Device type" objectType="7" dataType="0007" accessType="ro"/>
          <CANopenObject index="1001" name="Error register" objectType="7" dataType="0005" accessType="ro"/>
          <CANopenObject index="1017" name="Heartbeat period" objectType="7" dataType="0006" accessType="rw" defaultValue="0" actualValue="100"/>
          <CANopenObject index="1018" name="Identity" objectType="9" subNumber="2">
            <CANopenSubObject subIndex="00" name="Highest sub-index" objectType="7" dataType="0005" accessType="const" defaultValue="1"/>
            <CANopenSubObject subIndex="01" name="Vendor" objectType="7" dataType="0007" accessType="ro"/>
          </CANopenObject>
          <CANopenObject index="1800" name="TPDO 1" objectType="9" subNumber="2">
            <CANopenSubObject subIndex="00" name="Highest sub-index" objectType="7" dataType="0005" accessType="const" defaultValue="1"/>
            <CANopenSubObject subIndex="01" name="COB-ID" objectType="7" dataType="0007" accessType="rw" defaultValue="$NODEID+0x180" actualValue="0x185"/>
          </CANopenObject>
          <CANopenObject index="1A00" name="TPDO 1 mapping" objectType="9" subNumber="2">
            <CANopenSubObject subIndex="00" name="Number of entries" objectType="7" dataType="0005" accessType="rw" defaultValue="1"/>
            <CANopenSubObject subIndex="01" name="Entry 1" objectType="7" dataType="0007" accessType="rw" defaultValue="0x20000010"/>
          </CANopenObject>
          <CANopenObject index="2000" name="Speed" objectType="7" dataType="0006" accessType="rw" PDOmapping="TPDO" defaultValue="10" actualValue="20"/>
        </CANopenObjectList>
      </ApplicationLayers>
    </ProfileBody>
  </ISO15745Profile>
</ISO15745ProfileContainer>
